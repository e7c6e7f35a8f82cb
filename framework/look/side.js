// One side of the page: what is changed goes to the program, images come back. There is one request for a draft at a time;
// a newer request for a whole image takes the place of the one before.

const DRAFT_SHRINK = 4;
const STILL_MS = 150;  // After the last change, before the whole image is asked for

export class Side {
    /**
     * @param number of the session's side @param page id of this page
     * @param hooks functions, called with this side first: isMoving() whether the camera is being moved, extras() more
     * entries of a request, whole(answer) for a whole image, drawn(answer) for a drawn image, presented(answer, ms) when it is
     * on the screen, say(text) for errors, ended(error) when the program does not answer.
     */
    constructor(number, page, canvas, hooks) {
        Object.assign(this, { number, page, canvas, hooks });
        this.pending = new Map();  // What the program does not have yet, by path of the config, in order
        this.opened = {};  // A variant or a config to take first
        this.config = null;
        this.answer = null;  // The last one with a whole image
        // Numbers of states: of the newest one, and of those that images have shown
        this.version = 1;
        this.drafted = this.shown = 0;
        this.draftInFlight = false;
        this.wholeInFlight = this.lastChange = this.eventTime = this.timer = 0;
        this.hasEnded = false;
    }

    get isSettled() {
        return this.shown === this.version;
    }

    /** Takes a value of the config. @param time of the event that changed it */
    change(path, value, time) {
        for (const other of [...this.pending.keys()])  // A pass that is swapped has other parameters
            if (other === path || other.startsWith(path + ".")) this.pending.delete(other);
        this.pending.set(path, value);
        this.ask(time);
    }

    /** Takes all values of a variant or a config. @param opened a map with `variant` or `config` @param changes [path, value] */
    open(opened, changes, time) {
        this.opened = opened;
        this.pending = new Map(changes);
        this.ask(time);
    }

    /** Frees what the program holds for this side. */
    close() {
        clearTimeout(this.timer);
        this.pending.clear();
        this.opened = {};
        this.shown = this.version += 1;
        this.canvas.removeAttribute("aria-busy");
        const body = JSON.stringify({ page: this.page, side: this.number, close: true });
        fetch("image", { method: "POST", keepalive: true, body }).catch(() => {});
    }

    /** Asks for an image of what may have changed. */
    ask(time) {
        this.version += 1;
        this.eventTime = time;
        this.lastChange = performance.now();
        this.next();
    }

    /** Sends what is to be sent now. */
    next() {
        clearTimeout(this.timer);
        if (this.hasEnded || this.isSettled) return;
        const isStill = !this.hooks.isMoving(this) && performance.now() - this.lastChange >= STILL_MS;
        if (!isStill && this.drafted !== this.version && !this.draftInFlight) return this.send(DRAFT_SHRINK);
        if (isStill && this.wholeInFlight !== this.version && !this.draftInFlight) return this.send(1);
        this.timer = setTimeout(() => this.next(), STILL_MS / 3);
    }

    async send(shrink) {
        const sent = { version: this.version, pending: new Map(this.pending), opened: this.opened, time: this.eventTime };
        if (shrink > 1) this.draftInFlight = true;
        else this.wholeInFlight = this.version;
        this.canvas.setAttribute("aria-busy", "true");
        try {
            const response = await fetch("image", { method: "POST", body: JSON.stringify({
                page: this.page, side: this.number, shrink, ...sent.opened, ...this.hooks.extras(this),
                changes: [...sent.pending].map(([path, value]) => ({ path, value })) }) });
            const body = new Uint8Array(await response.arrayBuffer());
            if (response.status === 200) await this.take(body, sent, shrink);
            else if (response.status !== 204) {  // 204: a newer request took its place
                this.hooks.say(this, new TextDecoder().decode(body));
                this.shown = sent.version;
                this.pending.clear();
            }
        } catch (error) {
            this.hasEnded = true;
            this.hooks.ended(this, error);
        }
        if (shrink > 1) this.draftInFlight = false;
        else if (this.wholeInFlight === sent.version) this.wholeInFlight = 0;
        if (shrink > 1) this.drafted = sent.version;
        if (this.isSettled) this.canvas.removeAttribute("aria-busy");
        this.next();
    }

    /** Shows an answer: a line of JSON, then the image. */
    async take(body, sent, shrink) {
        const end = body.indexOf(10), answer = JSON.parse(new TextDecoder().decode(body.subarray(0, end)));
        if (shrink === 1) {
            if (sent.version < this.shown) return;
            this.shown = sent.version;
            for (const [path, value] of sent.pending) if (this.pending.get(path) === value) this.pending.delete(path);
            if (this.opened === sent.opened) this.opened = {};
            this.hooks.say(this, [...(answer.refused ?? []).map((refusal) => refusal.error), ...(answer.error ? [answer.error] : [])].join("\n"));
            this.config = answer.config;
            this.answer = answer;
            if (answer.variant && this.isSettled) Object.assign(this, { variant: answer.variant, isChanged: answer.changed });
            this.hooks.whole(this, answer);
        }
        if (answer.error) return;
        if (shrink > 1 && this.shown >= sent.version) return;  // The whole image was faster
        const image = await createImageBitmap(new Blob([body.subarray(end + 1)], { type: "image/png" }));
        if (shrink === 1 || !this.config) [this.canvas.width, this.canvas.height] = [image.width * shrink, image.height * shrink];
        this.canvas.classList.toggle("texels", "legend" in answer);
        this.canvas.getContext("2d").drawImage(image, 0, 0, this.canvas.width, this.canvas.height);
        const drawn = { ...answer, shrink };
        this.hooks.drawn(this, drawn);
        requestAnimationFrame(() => this.hooks.presented(this, drawn, performance.now() - sent.time));
    }
}
