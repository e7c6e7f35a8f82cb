"use strict";
// Two images side by side, and the zoom of all images.
(() => {
    const { state, onChange } = page;
    const sides = ["left", "right"];
    const imageOn = (side) => document.getElementById(`${state[side]}-${state.light}`);
    const nameOn = (side) => document.querySelector(`select[name="${side}"]`).selectedOptions[0].textContent;
    for (const side of sides) {
        const stage = document.querySelector(`.stage[data-side="${side}"]`);
        if (!stage) continue;
        page.addLayer(stage, () => [imageOn(side)]);
        page.addReadout(stage, () => sides.map((each) => [nameOn(each), imageOn(each)]));
        onChange([side, "light"], () => {
            const image = imageOn(side);
            if (!image) return;
            const ratio = `${image.getAttribute("width")} / ${image.getAttribute("height")}`;
            for (const element of [stage, stage.firstElementChild]) element.style.aspectRatio = ratio;
        });
    }

    // Zoomed images move together, by the part of the way that they have.
    const stages = [...document.querySelectorAll(".stage")];
    let leader = null;
    for (const stage of stages) {
        for (const kind of ["pointerenter", "focus", "wheel"]) {
            stage.addEventListener(kind, () => { leader = stage; }, { passive: true });
        }
        stage.addEventListener("scroll", () => {
            if (stage !== leader) return;
            const across = stage.scrollLeft / Math.max(1, stage.scrollWidth - stage.clientWidth);
            const down = stage.scrollTop / Math.max(1, stage.scrollHeight - stage.clientHeight);
            for (const other of stages) {
                if (other === stage || !other.clientWidth) continue;
                other.scrollTo({ left: across * (other.scrollWidth - other.clientWidth),
                                 top: down * (other.scrollHeight - other.clientHeight), behavior: "instant" });
            }
        });
    }
})();
