// Viewers: a variant's image with another one over it, by a slider, in turns or as its error.

const viewers = [...document.querySelectorAll(".viewer")];
const nameOfOther = () => (state.against ? document.querySelector('select[name="against"]').selectedOptions[0].textContent : "reference");
const flip = () => set({ show: state.show === "variant" ? "other" : "variant" });
onChange(["split"], () => root.style.setProperty("--split", `${state.split}%`));
onChange(["zoom"], () => root.style.setProperty("--zoom", state.zoom));

// The image to lay over a variant's: its reference, or the same light of the variant that is chosen for all.
const otherOf = (viewer) => byId(state.against ? `${state.against}-${viewer.dataset.light}` : viewer.dataset.reference);

for (const viewer of viewers) {
    const canvas = viewer.firstElementChild, image = canvas.querySelector(".photo");
    addLayer(viewer, () => [image, state.show === "error" ? otherOf(viewer) : null]);
    addLayer(viewer, () => [otherOf(viewer)], "ref");
    canvas.append(element("div", { class: "line" }));
    viewer.parentElement.append(element("span", { class: "tag left" }, "variant"), element("span", { class: "tag right" }));
    addReadout(viewer, () => [["variant", image], [nameOfOther(), otherOf(viewer)]]);

    const moveTo = (event) => {
        const box = canvas.getBoundingClientRect(), split = (100 * (event.clientX - box.left)) / box.width;
        set({ split: String(Math.min(100, Math.max(0, Math.round(split)))) }, false);
    };
    viewer.addEventListener("pointerdown", (event) => {
        if (event.button !== 0 || event.offsetX > viewer.clientWidth + viewer.scrollLeft) return;
        if (state.show === "variant" || state.show === "other") return flip();
        if (state.show !== "slider") return;
        viewer.setPointerCapture(event.pointerId);
        moveTo(event);
    });
    viewer.addEventListener("pointermove", (event) => {
        if (viewer.hasPointerCapture(event.pointerId)) moveTo(event);
    });
    viewer.addEventListener("pointerup", writeAddress);
    viewer.addEventListener("dragstart", (event) => event.preventDefault());
}
onChange(["against"], () => {
    for (const viewer of viewers) viewer.classList.toggle("alone", !otherOf(viewer));
    for (const tag of document.querySelectorAll(".tag.right")) tag.textContent = nameOfOther();
});

for (const stage of document.querySelectorAll(".single-view")) {
    const image = stage.querySelector(".photo");
    addLayer(stage, () => [image]);
    addReadout(stage, () => [["reference", image]]);
}

// Zoomed images move together, by the part of the way that they have.
const stages = [...document.querySelectorAll(".stage")];
let leader = null;
for (const stage of stages) {
    for (const kind of ["pointerenter", "focus", "wheel"]) stage.addEventListener(kind, () => { leader = stage; }, { passive: true });
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

// Small copies of images that stand elsewhere on the page.
for (const link of document.querySelectorAll(".copy")) link.prepend(element("img", { alt: "", src: byId(link.dataset.image).src }));
