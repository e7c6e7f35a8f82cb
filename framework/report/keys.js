"use strict";
// Keys for the whole page; then the page is what its address says.
(() => {
    const { state, set, next } = page;
    const filter = document.querySelector('input[name="filter"]');
    const expose = (stops) => set({ exposure: String(Number(state.exposure) + stops) });
    const brighter = () => expose(1), darker = () => expose(-1);
    const shortcuts = {
        f: page.flip, s: () => set({ show: "slider" }), e: () => set({ show: "error" }), c: () => next("colors"), l: () => next("light"), z: () => next("zoom"),
        "+": brighter, "=": brighter, "-": darker, "/": () => filter?.focus(),
    };
    document.addEventListener("keydown", (event) => {
        if (event.target === filter && event.key === "Escape") {
            set({ filter: "" });
            filter.blur();
        }
        if (event.ctrlKey || event.metaKey || event.altKey || event.target.matches('input[type="search"], select')) return;
        const run = shortcuts[event.key.toLowerCase()];
        if (!run) return;
        if (event.key === "/") event.preventDefault();
        run();
    });
    page.readAddress();
})();
