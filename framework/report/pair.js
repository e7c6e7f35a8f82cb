"use strict";
// Two images side by side, and the zoom of all images.
(() => {
    for (const side of ["left", "right"]) {
        const stage = document.querySelector(`.stage[data-side="${side}"]`);
        if (!stage) continue;
        const image = new Image();
        image.className = "photo";
        stage.firstElementChild.append(image);
        page.onChange([side, "light"], () => {
            const source = document.getElementById(`${page.state[side]}-${page.state.light}`);
            image.hidden = !source;
            if (!source) return;
            image.src = source.src;
            image.alt = source.alt;
            stage.style.aspectRatio = `${source.getAttribute("width")} / ${source.getAttribute("height")}`;
        });
    }

    // Pixels are shown as squares where they are enlarged, and averaged where they are reduced.
    function sharpen() {
        for (const image of document.querySelectorAll(".canvas img, .single img, .film img")) {
            if (image.clientWidth) image.classList.toggle("sharp", image.clientWidth >= image.naturalWidth);
        }
    }
    page.onChange(["zoom", "light"], sharpen);
    addEventListener("resize", sharpen);
    addEventListener("load", sharpen);

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
