"use strict";
// Viewers: a variant's image with another one over it, by a slider, in turns or as its error.
(() => {
    const { state, set, onChange } = page;
    const viewers = [...document.querySelectorAll(".viewer")];
    const nameOfOther = () => (state.against ? document.querySelector('select[name="against"]').selectedOptions[0].textContent : "reference");

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

    for (const viewer of viewers) {
        const canvas = viewer.firstElementChild;
        const image = canvas.querySelector(".photo");
        page.addLayer(viewer, () => [image, state.show === "error" ? otherOf(viewer) : null]);
        page.addLayer(viewer, () => [otherOf(viewer)], "ref");
        const line = document.createElement("div");
        line.className = "line";
        canvas.append(line);
        addTag(viewer.parentElement, "left").textContent = "variant";
        addTag(viewer.parentElement, "right");
        page.addReadout(viewer, () => [["variant", image], [nameOfOther(), otherOf(viewer)]]);

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
    }
    page.flip = () => set({ show: state.show === "variant" ? "other" : "variant" });
    onChange(["against"], () => {
        for (const viewer of viewers) viewer.classList.toggle("alone", !otherOf(viewer));
        for (const tag of document.querySelectorAll(".tag.right")) tag.textContent = nameOfOther();
    });

    for (const stage of document.querySelectorAll(".single-view")) {
        const image = stage.querySelector(".photo");
        page.addLayer(stage, () => [image]);
        page.addReadout(stage, () => [["reference", image]]);
    }

    // Small copies of images that stand elsewhere on the page.
    for (const link of document.querySelectorAll(".copy")) {
        const copy = new Image();
        copy.alt = "";
        copy.src = document.getElementById(link.dataset.image).src;
        link.prepend(copy);
    }
})();
