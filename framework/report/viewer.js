"use strict";
// The page's state: which light, what of the images, where the slider stands, how much zoom. All viewers share it,
// so that one place can be compared across variants, and it is kept in the address (#light=total&split=30).
(() => {
    const root = document.documentElement;
    const defaults = { light: root.dataset.light, show: "slider", zoom: "1", time: "frame", split: "50" };
    const choices = Object.fromEntries(["light", "show", "zoom", "time"].map(
        (key) => [key, [...document.querySelectorAll(`input[name="${key}"]`)].map((input) => input.value)]));
    const state = { ...defaults };

    function isValid(key, value) {
        if (key === "split") return value !== "" && Number(value) >= 0 && Number(value) <= 100;
        return key in choices && choices[key].includes(value);
    }

    function set(changes, remember = true) {
        for (const [key, value] of Object.entries(changes)) if (isValid(key, value)) state[key] = value;
        for (const key of ["light", "show", "time", "zoom"]) root.dataset[key] = state[key];
        root.style.setProperty("--split", `${state.split}%`);
        root.style.setProperty("--zoom", state.zoom);
        for (const key of Object.keys(choices)) {
            const input = document.querySelector(`input[name="${key}"][value="${state[key]}"]`);
            if (input) input.checked = true;
        }
        for (const stage of document.querySelectorAll('[role="slider"]')) {
            stage.setAttribute("aria-valuenow", Math.round(Number(state.split)));
        }
        sharpen();
        if (remember) writeAddress();
    }

    // The address holds what differs from the defaults, in addition to the anchor that it may lead to.
    function addressParts() {
        return location.hash.slice(1).split("&");
    }
    function readAddress() {
        set(Object.fromEntries(addressParts().filter((part) => part.includes("=")).map((part) => part.split("="))), false);
        const anchor = addressParts().find((part) => part && !part.includes("="));
        const target = anchor && document.getElementById(anchor);
        if (anchor === "reference") target?.querySelector("details").setAttribute("open", "");
        target?.scrollIntoView();
    }
    function writeAddress() {
        const parts = addressParts().filter((part) => part && !part.includes("="));
        for (const key of Object.keys(defaults)) if (state[key] !== defaults[key]) parts.push(`${key}=${state[key]}`);
        history.replaceState(null, "", parts.length ? `#${parts.join("&")}` : location.pathname + location.search);
    }

    // Pixels are shown as squares where they are enlarged, and averaged where they are reduced.
    function sharpen() {
        for (const image of document.querySelectorAll(".canvas img, .single img")) {
            if (image.clientWidth) image.classList.toggle("sharp", image.clientWidth >= image.naturalWidth);
        }
    }

    // A variant's image becomes a viewer where there is a reference to lay over it.
    function addTag(figure, side, text) {
        const tag = document.createElement("span");
        tag.className = `tag ${side}`;
        tag.textContent = text;
        figure.append(tag);
    }
    for (const stage of document.querySelectorAll(".viewer")) {
        const reference = document.getElementById(stage.dataset.reference);
        if (!reference) {
            stage.classList.remove("viewer");
            stage.closest("figure").querySelector(".side")?.remove();
            continue;
        }
        const canvas = stage.firstElementChild;
        const overlay = new Image();
        overlay.className = "ref";
        overlay.alt = "";
        overlay.src = reference.src;
        const line = document.createElement("div");
        line.className = "line";
        canvas.append(overlay, line);
        addTag(stage.parentElement, "left", "variant");
        addTag(stage.parentElement, "right", "reference");
        for (const [name, value] of Object.entries({ role: "slider", tabindex: "0", "aria-valuemin": "0", "aria-valuemax": "100" })) {
            stage.setAttribute(name, value);
        }

        const moveTo = (event) => {
            const box = canvas.getBoundingClientRect();
            const split = (100 * (event.clientX - box.left)) / box.width;
            set({ split: String(Math.min(100, Math.max(0, Math.round(split * 10) / 10))) }, false);
        };
        stage.addEventListener("pointerdown", (event) => {
            if (event.button !== 0 || event.offsetX > stage.clientWidth + stage.scrollLeft) return;
            if (state.show !== "slider") return flip();
            stage.setPointerCapture(event.pointerId);
            moveTo(event);
        });
        stage.addEventListener("pointermove", (event) => {
            if (stage.hasPointerCapture(event.pointerId)) moveTo(event);
        });
        stage.addEventListener("pointerup", writeAddress);
        stage.addEventListener("dragstart", (event) => event.preventDefault());
        stage.addEventListener("keydown", (event) => {
            const steps = { ArrowLeft: -2, ArrowRight: 2, PageDown: -10, PageUp: 10, Home: -100, End: 100 };
            if (!(event.key in steps) || event.shiftKey || event.ctrlKey || event.metaKey || event.altKey) return;
            event.preventDefault();
            set({ show: "slider", split: String(Math.min(100, Math.max(0, Number(state.split) + steps[event.key]))) });
        });
    }

    // Small copies of images that stand elsewhere on the page.
    for (const link of document.querySelectorAll(".thumbnail")) {
        const copy = new Image();
        copy.alt = "";
        copy.src = document.getElementById(link.dataset.image).src;
        link.prepend(copy);
    }

    // Zoomed images move together.
    const stages = [...document.querySelectorAll(".stage")];
    let leader = null;
    for (const stage of stages) {
        for (const kind of ["pointerenter", "focus", "wheel"]) {
            stage.addEventListener(kind, () => { leader = stage; }, { passive: true });
        }
        stage.addEventListener("scroll", () => {
            if (stage !== leader) return;
            for (const other of stages) {
                if (other !== stage) other.scrollTo({ left: stage.scrollLeft, top: stage.scrollTop, behavior: "instant" });
            }
        });
    }

    function flip() {
        set({ show: state.show === "variant" ? "reference" : "variant" });
    }
    function next(key) {
        const values = choices[key];
        set({ [key]: values[(values.indexOf(state[key]) + 1) % values.length] });
    }
    const shortcuts = { f: flip, s: () => set({ show: "slider" }), l: () => choices.light.length && next("light"), z: () => next("zoom") };
    document.addEventListener("keydown", (event) => {
        if (event.ctrlKey || event.metaKey || event.altKey) return;
        shortcuts[event.key.toLowerCase()]?.();
    });
    document.addEventListener("change", (event) => {
        if (event.target.name in choices) set({ [event.target.name]: event.target.value });
    });

    // A heading sorts the table by its column; what has no value stays last.
    for (const button of document.querySelectorAll(".results thead button")) {
        button.addEventListener("click", () => {
            const heading = button.closest("th");
            const index = heading.cellIndex;
            const direction = heading.getAttribute("aria-sort") === "ascending" ? -1 : 1;
            const numeric = button.hasAttribute("data-numeric");
            const body = button.closest("table").tBodies[0];
            const keyOf = (row) => row.cells[index].dataset.sort ?? "";
            const toNumber = (key) => ({ inf: Infinity, "-inf": -Infinity })[key] ?? Number(key);
            const compare = (a, b) => {
                const [x, y] = [keyOf(a), keyOf(b)];
                if (!x || !y) return (x ? 0 : 1) - (y ? 0 : 1);
                if (!numeric) return direction * x.localeCompare(y);
                const [p, q] = [toNumber(x), toNumber(y)];
                return p === q ? 0 : direction * (p < q ? -1 : 1);
            };
            body.append(...[...body.rows].sort(compare));
            for (const other of heading.parentElement.cells) other.removeAttribute("aria-sort");
            heading.setAttribute("aria-sort", direction > 0 ? "ascending" : "descending");
        });
    }

    addEventListener("hashchange", readAddress);
    addEventListener("resize", sharpen);
    addEventListener("load", sharpen);
    readAddress();
})();
