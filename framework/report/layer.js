"use strict";
// Canvases that show images by the page's state. They are drawn where they are in sight: a page may have hundreds.
(() => {
    const { state, onChange } = page;
    const layers = new Map(); // by canvas
    const inSight = new Set();

    async function draw(canvas) {
        const layer = layers.get(canvas);
        const [image, reference] = layer.sources();
        const wanted = [image?.id, reference?.id, state.colors, state.exposure].join(" ");
        if (layer.drawn === wanted) return;
        layer.drawn = wanted;
        canvas.style.visibility = image ? "" : "hidden";
        if (!image) return;
        canvas.setAttribute("aria-busy", "true");
        const [pixels, right] = await Promise.all([image, reference].map((source) => source && page.pixelsOf(source)));
        if (layer.drawn !== wanted) return; // another change came meanwhile
        canvas.width = pixels.width;
        canvas.height = pixels.height;
        canvas.getContext("2d").putImageData(page.shade(pixels, right), 0, 0);
        canvas.removeAttribute("aria-busy");
        sharpen();
    }
    const watcher = new IntersectionObserver((entries) => {
        for (const { target, isIntersecting } of entries) {
            if (isIntersecting) {
                inSight.add(target);
                draw(target);
            } else {
                inSight.delete(target);
            }
        }
    }, { rootMargin: "500px" });
    onChange(["colors", "exposure", "show", "against", "left", "right", "light"], () => inSight.forEach(draw));
    onChange(["exposure"], () => {
        const stated = document.querySelector(".stops");
        if (stated) stated.textContent = `${state.exposure > 0 ? "+" : ""}${Number(state.exposure)}`;
    });

    // Adds a canvas to what an image stands in. @param sources returns the image to show, and what its error is to be shown against
    page.addLayer = (parent, sources, name = "") => {
        const canvas = document.createElement("canvas");
        canvas.className = name;
        canvas.setAttribute("aria-hidden", "true");
        parent.append(canvas);
        layers.set(canvas, { sources });
        watcher.observe(canvas);
    };

    // Pixels are shown as squares where they are enlarged, and averaged where they are reduced.
    function sharpen() {
        for (const image of document.querySelectorAll(".canvas img, .canvas canvas, .film img")) {
            if (image.clientWidth) image.classList.toggle("sharp", image.clientWidth >= (image.naturalWidth ?? image.width));
        }
    }
    onChange(["zoom", "light"], sharpen);
    addEventListener("resize", sharpen);
    addEventListener("load", sharpen);
})();
