// Two sides over or beside one another, one of which is edited.

import { onKey } from "./keys.js";

export const SIDE_NAMES = ["A", "B"];

/** What a scene is made of. Cameras of two configs mean the same if that is. */
const sourceOf = (scene) => scene.file ?? scene.builtin;
const isOfImage = (path) => path === "image" || path.startsWith("image.");
const OF_PATH = ["frames", "compare_every"];  // What measure says of a path of the camera
const isOfCamera = (path) => path === "scene.camera" || OF_PATH.some((key) => path === `measure.${key}`);

export class Split {
    /**
     * @param place of the images @param sides both @param variants with id, name and source of the scene
     * @param hooks edited(side): another side is edited, or it has another name
     */
    constructor(place, sides, variants, hooks) {
        Object.assign(this, { place, sides, variants, hooks });
        this.edited = sides[0];
        this.isOpen = false;
        [this.compare, this.layout, this.slider] = ["compare", "layout", "split"].map((name) => document.querySelector(`[name=${name}]`));
        this.captions = [...place.querySelectorAll("figcaption button")];
        for (const side of sides) Object.assign(side, { name: "", variant: "", isChanged: false });
        this.nameBy(sides[0], variants[0]);

        this.compare.append(...variants.map(({ name }) => new Option(name)), new Option("this state"));
        this.compare.addEventListener("change", () => this.choose(this.compare.selectedIndex));
        this.layout.addEventListener("change", () => this.arrange());
        this.slider.addEventListener("input", () => this.arrange());
        for (const [i, button] of this.captions.entries()) button.addEventListener("click", () => this.edit(i));
        onKey("KeyX", () => this.isOpen && this.edit(1 - this.edited.number));
        this.arrange();
    }

    get shown() {
        return this.isOpen ? this.sides : [this.sides[0]];
    }

    /** Sides that take a value: settings of the image are of both, the camera, too, where both show the same scene. */
    sidesOf(path) {
        return isOfImage(path) || (isOfCamera(path) && this.isSameScene()) ? this.shown : [this.edited];
    }

    isSameScene() {
        return this.shown.every((side) => !side.config || sourceOf(side.config.scene) === sourceOf(this.sides[0].config.scene));
    }

    /**
     * Takes the values of a variant for the side that is edited. Beside another side, image and camera are as there; alone, camera
     * and exposure stay if they are not those of the variant that is shown.
     */
    select(variant) {
        const source = this.isOpen ? this.sides[1 - this.edited.number] : this.edited;
        const shared = source.config ? this.sharedBy(source, variant) : [];
        const kept = this.isOpen ? shared : this.changesOfView(source, shared);
        this.nameBy(this.edited, variant);
        this.edited.open({ variant: variant.id }, kept, performance.now());
        this.arrange();
    }

    /** Compares side A with: nothing, a variant, or what it shows now. @param index in the list of these */
    choose(index) {
        const [first, second] = this.sides, variant = this.variants[index - 1];
        this.isOpen = index > 0;
        if (!this.isOpen) {
            second.close();
            return this.edit(0);
        }
        if (variant) this.nameBy(second, variant);
        else Object.assign(second, { name: `${first.name}, pinned`, variant: first.variant, isChanged: false });
        if (variant) second.open({ variant: variant.id }, this.sharedBy(first, variant), performance.now());
        else second.open({ config: first.config }, first.pending, performance.now());
        this.edit(this.edited.number);
    }

    /** Changes that give a variant the image settings and the camera of a side. */
    sharedBy(side, variant) {
        const { config } = side, isSameScene = variant.source === sourceOf(config.scene);
        return [["image", config.image ?? null],
            ...(isSameScene && config.scene.camera?.path ? OF_PATH.map((key) => [`measure.${key}`, config.measure?.[key] ?? null]) : []),
            ...(isSameScene ? [["scene.camera", config.scene.camera ?? null]] : []), ...[...side.pending].filter(([path]) => isOfImage(path) || (isOfCamera(path) && isSameScene))];
    }

    /** Of changes that sharedBy() told, those that the view of a side needs, which may be another one than its variant's. */
    changesOfView({ variant, config, pending }, shared) {
        const own = this.variants.find(({ id }) => id === variant), stops = "image.exposure_stops";
        const differs = (value, original) => JSON.stringify(value ?? null) !== JSON.stringify(original ?? null);
        const isFlown = pending.has("scene.camera") || !own || differs(config?.scene.camera, own.camera);
        const exposed = pending.get(stops) ?? config?.image?.exposure_stops;
        return [...(isFlown ? shared.filter(([path]) => !isOfImage(path)) : []),
            ...(own && differs(exposed ?? 0, own.exposure_stops ?? 0) ? [[stops, exposed ?? null]] : [])];
    }

    nameBy(side, variant) {
        Object.assign(side, { name: variant.name, variant: variant.id, isChanged: false });
    }

    titleOf(side) {
        return `${this.isOpen ? `${SIDE_NAMES[side.number]}: ` : ""}${side.name}${side.isChanged ? ", changed" : ""}`;
    }

    /** The program has told what variant a side shows; another page may have chosen it, or this one before it was reloaded. */
    follow(side) {
        const variant = this.variants.find(({ id }) => id === side.variant);
        if (variant && side.answer?.variant === variant.id) side.name = variant.name;
        this.arrange();
    }

    edit(number) {
        this.edited = this.sides[number];
        this.arrange();
        this.hooks.edited(this.edited);
    }

    arrange() {
        const layout = this.layout.value;
        this.place.className = this.isOpen ? layout : "";
        this.place.style.setProperty("--split", this.slider.value / 100);
        this.layout.closest("label").hidden = !this.isOpen;
        this.slider.hidden = !this.isOpen || layout !== "over";
        this.sides[1].canvas.closest("figure").hidden = !this.isOpen;
        for (const [i, button] of this.captions.entries()) {
            const side = this.sides[i];
            button.hidden = !this.isOpen;
            button.textContent = `${this.titleOf(side)}${this.edited === side ? " (being edited)" : ""}`;
            button.setAttribute("aria-pressed", this.edited === side);
        }
    }
}
