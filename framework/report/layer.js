// Canvases that show images by the page's state. They have pixels where they are in sight: a page may have hundreds.

const layers = new Map(); // by stage
const inSight = new Set();

async function drawLayer(layer) {
    const { canvas, sources } = layer;
    const [image, reference] = sources();
    const wanted = [image?.id, reference?.id, state.colors, state.exposure].join(" ");
    if (layer.drawn === wanted) return;
    layer.drawn = wanted;
    canvas.hidden = !image;
    canvas.setAttribute("aria-busy", String(Boolean(image)));
    if (!image) return;
    const [pixels, compared] = await Promise.all([image, reference].map((source) => source && pixelsOf(source)));
    if (layer.drawn !== wanted) return; // another change came meanwhile
    canvas.width = pixels.width;
    canvas.height = pixels.height;
    canvas.getContext("2d").putImageData(shade(pixels, compared), 0, 0);
    canvas.setAttribute("aria-busy", "false");
    sharpen();
}
function releaseLayer(layer) {
    layer.drawn = "";
    layer.canvas.width = layer.canvas.height = 0;
    layer.canvas.setAttribute("aria-busy", "false");
}
const watcher = new IntersectionObserver((entries) => {
    for (const { target, isIntersecting } of entries) {
        inSight[isIntersecting ? "add" : "delete"](target);
        layers.get(target).forEach(isIntersecting ? drawLayer : releaseLayer);
    }
}, { rootMargin: "500px" });
onChange(["colors", "exposure", "show", "against", "light"], () => {
    for (const stage of inSight) layers.get(stage).forEach(drawLayer);
});
onChange(["exposure"], () => {
    document.querySelector(".stops").textContent = `${state.exposure > 0 ? "+" : ""}${Number(state.exposure)}`;
});

// @param sources returns the image to show and, for its error, what it is compared with
function addLayer(stage, sources, name = "") {
    const canvas = element("canvas", { class: name, "aria-hidden": "true" });
    stage.firstElementChild.append(canvas);
    layers.set(stage, [...(layers.get(stage) ?? []), { canvas, sources }]);
    watcher.observe(stage);
}

// Pixels are shown as squares where they are enlarged, and averaged where they are reduced.
function sharpen() {
    for (const image of document.querySelectorAll(".canvas img, .canvas canvas, .film img")) {
        if (image.clientWidth) image.classList.toggle("sharp", image.clientWidth >= (image.naturalWidth ?? image.width));
    }
}
onChange(["zoom", "light"], sharpen);
addEventListener("resize", sharpen);
addEventListener("load", sharpen);
