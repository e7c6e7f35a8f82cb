"use strict";
// The page's state: which light, what of the images, where the slider stands, zoom, exposure, filter. All viewers share it,
// so that one place can be compared across variants, and it is kept in the address (#light=total&split=30).
const page = (() => {
    const root = document.documentElement;
    const onRoot = ["light", "show", "zoom", "time", "colors"]; // style.css goes by them
    const maxStops = 10;

    // Controls by the key that they choose; radio buttons are one control.
    const controls = new Map();
    for (const control of document.querySelectorAll("input[name], select[name]")) {
        controls.set(control.name, [...(controls.get(control.name) ?? []), control]);
    }
    function valuesOf(key) {
        return (controls.get(key) ?? []).flatMap((control) =>
            control.options ? [...control.options].map((option) => option.value) : [control.value]);
    }
    const choices = Object.fromEntries(["light", "show", "zoom", "time", "against", "left", "right", "colors"].map((key) => [key, valuesOf(key)]));
    const defaults = {
        light: root.dataset.light, show: "slider", zoom: "1", time: "frame", split: "50", exposure: "0", colors: root.dataset.colors, filter: "", against: "",
        left: choices.left[0] ?? "", right: choices.right[1] ?? choices.right[0] ?? "",
    };
    const state = { ...defaults };
    const listeners = [];

    function isValid(key, value) {
        if (key === "split") return value !== "" && Number(value) >= 0 && Number(value) <= 100;
        if (key === "exposure") return value !== "" && Math.abs(Number(value)) <= maxStops;
        return key === "filter" || (choices[key]?.includes(value) ?? false);
    }

    function set(changes, remember = true) {
        const changed = Object.keys(changes).filter((key) => isValid(key, changes[key]));
        for (const key of changed) state[key] = changes[key];
        for (const key of onRoot) root.dataset[key] = state[key];
        root.style.setProperty("--split", `${state.split}%`);
        root.style.setProperty("--zoom", state.zoom);
        for (const [key, group] of controls) {
            for (const control of group) {
                if (control.type === "radio") control.checked = control.value === state[key];
                else if (key in state && control.value !== state[key]) control.value = state[key];
            }
        }
        for (const { keys, run } of listeners) if (keys.some((key) => changed.includes(key))) run();
        if (remember) writeAddress();
    }

    // Runs now and after each change of one of the keys.
    function onChange(keys, run) {
        listeners.push({ keys, run });
        run();
    }
    function next(key) {
        const values = choices[key];
        if (values.length > 0) set({ [key]: values[(values.indexOf(state[key]) + 1) % values.length] });
    }

    // The address holds what differs from the defaults, in addition to the anchor that it may lead to.
    function addressParts() {
        return location.hash.slice(1).split("&").filter((part) => part);
    }
    function decoded(text) {
        try {
            return decodeURIComponent(text);
        } catch {
            return text;
        }
    }
    function readAddress() {
        const pairs = addressParts().filter((part) => part.includes("="));
        set(Object.fromEntries(pairs.map((part) => [part.slice(0, part.indexOf("=")), decoded(part.slice(part.indexOf("=") + 1))])), false);
        const anchor = addressParts().find((part) => !part.includes("="));
        const target = anchor && document.getElementById(anchor);
        if (anchor === "reference") target?.querySelector("details").setAttribute("open", "");
        if (anchor === "warnings") target?.setAttribute("open", "");
        if (target?.hidden) page.showAllRows?.();
        target?.scrollIntoView();
    }
    function writeAddress() {
        const parts = addressParts().filter((part) => !part.includes("="));
        for (const key of Object.keys(defaults)) {
            if (state[key] !== defaults[key]) parts.push(`${key}=${encodeURIComponent(state[key])}`);
        }
        history.replaceState(null, "", parts.length ? `#${parts.join("&")}` : location.pathname + location.search);
    }

    document.addEventListener("input", ({ target }) => {
        if (controls.has(target.name) && target.name in state) set({ [target.name]: target.value });
    });
    addEventListener("hashchange", readAddress);
    return { state, set, next, onChange, readAddress, writeAddress };
})();
