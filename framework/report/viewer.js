"use strict";
// Viewers: a variant's image with another one over it, by a slider, in turns or as their difference.
(() => {
    const { state, set, onChange } = page;
    const viewers = [...document.querySelectorAll(".viewer")];

    // The image to lay over a variant's: its reference, or the same light of the variant that is chosen for all.
    function otherOf(viewer) {
        return document.getElementById(state.against ? `${state.against}-${viewer.dataset.light}` : viewer.dataset.reference);
    }
    function addTag(figure, side) {
        const tag = document.createElement("span");
        tag.className = `tag ${side}`;
        figure.append(tag);
        return tag;
    }
    function layOver(viewer) {
        const other = otherOf(viewer);
        viewer.classList.toggle("alone", !other);
        const overlay = viewer.querySelector(".ref");
        if (other) overlay.src = other.src;
        else overlay.removeAttribute("src");
    }

    for (const viewer of viewers) {
        const canvas = viewer.firstElementChild;
        const overlay = new Image();
        overlay.className = "photo ref";
        overlay.alt = "";
        const line = document.createElement("div");
        line.className = "line";
        canvas.append(overlay, line);
        addTag(viewer.parentElement, "left").textContent = "variant";
        addTag(viewer.parentElement, "right");
        for (const [name, value] of Object.entries({ role: "slider", tabindex: "0", "aria-valuemin": "0", "aria-valuemax": "100" })) {
            viewer.setAttribute(name, value);
        }

        const moveTo = (event) => {
            const box = canvas.getBoundingClientRect();
            const split = (100 * (event.clientX - box.left)) / box.width;
            set({ split: String(Math.min(100, Math.max(0, Math.round(split * 10) / 10))) }, false);
        };
        viewer.addEventListener("pointerdown", (event) => {
            if (event.button !== 0 || event.offsetX > viewer.clientWidth + viewer.scrollLeft) return;
            if (state.show === "variant" || state.show === "other") return page.flip();
            if (state.show !== "slider") return;
            viewer.setPointerCapture(event.pointerId);
            moveTo(event);
        });
        viewer.addEventListener("pointermove", (event) => {
            if (viewer.hasPointerCapture(event.pointerId)) moveTo(event);
        });
        viewer.addEventListener("pointerup", page.writeAddress);
        viewer.addEventListener("dragstart", (event) => event.preventDefault());
        viewer.addEventListener("keydown", (event) => {
            const steps = { ArrowLeft: -2, ArrowRight: 2, PageDown: -10, PageUp: 10, Home: -100, End: 100 };
            if (!(event.key in steps) || event.shiftKey || event.ctrlKey || event.metaKey || event.altKey) return;
            event.preventDefault();
            set({ show: "slider", split: String(Math.min(100, Math.max(0, Number(state.split) + steps[event.key]))) });
        });
    }
    page.flip = () => set({ show: state.show === "variant" ? "other" : "variant" });

    // Overlays get their images where the page is looked at: a page may have hundreds.
    const inSight = new Set();
    const watcher = new IntersectionObserver((entries) => {
        for (const { target, isIntersecting } of entries) {
            if (!isIntersecting || inSight.has(target)) continue;
            inSight.add(target);
            layOver(target);
        }
    }, { rootMargin: "1000px" });
    for (const viewer of viewers) watcher.observe(viewer);
    onChange(["against"], () => {
        inSight.forEach(layOver);
        const name = document.querySelector('select[name="against"]')?.selectedOptions[0].textContent;
        for (const tag of document.querySelectorAll(".tag.right")) tag.textContent = state.against ? name : "reference";
    });
    onChange(["split"], () => {
        for (const viewer of viewers) viewer.setAttribute("aria-valuenow", Math.round(Number(state.split)));
    });

    // Exposure, of previews: sRGB to linear radiance and back. What a preview clips stays clipped.
    const toLinear = (v) => (v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4);
    const toDisplay = (v) => (v <= 0.0031308 ? 12.92 * v : 1.055 * v ** (1 / 2.4) - 0.055);
    onChange(["exposure"], () => {
        const stops = Number(state.exposure);
        const values = Array.from({ length: 256 }, (_, i) => toDisplay(Math.min(1, toLinear(i / 255) * 2 ** stops)).toFixed(5));
        for (const curve of document.querySelectorAll("#exposure feFuncR, #exposure feFuncG, #exposure feFuncB")) {
            curve.setAttribute("type", stops === 0 ? "identity" : "table");
            curve.setAttribute("tableValues", values.join(" "));
        }
        const stated = document.querySelector(".stops");
        if (stated) stated.textContent = `${stops > 0 ? "+" : ""}${stops}`;
    });

    // Small copies of images that stand elsewhere on the page.
    for (const link of document.querySelectorAll(".copy")) {
        const copy = new Image();
        copy.alt = "";
        copy.src = document.getElementById(link.dataset.image).src;
        link.prepend(copy);
    }
})();
