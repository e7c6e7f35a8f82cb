// Which keys are free for the page.

const USED_BY = [
    ["select, textarea, input:not([type=range], [type=checkbox], [type=radio])", () => true],
    ["input[type=range], input[type=radio]", (code) => /^(Arrow|Page|Home|End)/.test(code)],
    ["button, summary, a, input", (code) => ["Space", "Enter"].includes(code)],
];

/** Whether neither the browser nor the control in focus uses the key of an event. */
export function isFree(event) {
    if (event.ctrlKey || event.metaKey || event.altKey || event.defaultPrevented) return false;
    return !USED_BY.some(([controls, uses]) => event.target.closest(controls) && uses(event.code));
}

/** After a list was used by the mouse, keys are the page's again. @param place gets the focus */
export function freeKeysAfterMouse(place) {
    let isByMouse = false;
    document.addEventListener("pointerdown", () => (isByMouse = true), true);
    document.addEventListener("keydown", () => (isByMouse = false), true);
    document.addEventListener("change", (event) => {
        if (isByMouse && event.target.matches("select, input[type=checkbox]")) place().focus({ preventScroll: true });
    });
}

/** Calls an action where its key is pressed and free. */
export function onKey(code, action) {
    document.addEventListener("keydown", (event) => {
        if (event.code !== code || event.repeat || !isFree(event)) return;
        event.preventDefault();
        action();
    });
}
