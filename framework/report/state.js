// The state of a page's controls, by their names. It is kept in the address (#light=total&split=30), and what the root element has as
// data (<html data-light>) follows it, for style.css.

const root = document.documentElement;
const controls = new Map(); // radio buttons are one
for (const control of document.querySelectorAll("input[name], select[name]")) {
    controls.set(control.name, [...(controls.get(control.name) ?? []), control]);
}
const valuesOf = (key) => (controls.get(key) ?? []).flatMap((control) =>
    (control.options ? [...control.options].map((option) => option.value) : [control.value]));

function startOf([key, group]) {
    const [first] = group, chosen = first.options ? [...first.options].find((option) => option.defaultSelected) : group.find((one) => one.defaultChecked);
    return [key, (chosen ?? first).value];
}
const defaults = { ...root.dataset, ...Object.fromEntries([...controls].map(startOf)) };
const state = { ...defaults };
const listeners = [];

function isValid(key, value) {
    const [first] = controls.get(key) ?? [];
    if (first?.type === "search") return true;
    if (first?.type === "range") return value !== "" && Number(value) >= Number(first.min) && Number(value) <= Number(first.max);
    return valuesOf(key).includes(value);
}

function set(changes, remember = true) {
    const changed = Object.keys(changes).filter((key) => isValid(key, changes[key]));
    for (const key of changed) state[key] = changes[key];
    for (const key of Object.keys(root.dataset)) root.dataset[key] = state[key];
    for (const [key, group] of controls) {
        for (const control of group) {
            if (control.type === "radio") control.checked = control.value === state[key];
            else if (control.value !== state[key]) control.value = state[key];
        }
    }
    for (const { keys, run } of listeners) if (keys.some((key) => changed.includes(key))) run();
    if (remember) writeAddress();
}

// Runs now and after each change of one of the keys.
function onChange(keys, run) {
    listeners.push({ keys, run });
    run();
}
function next(key) {
    const values = valuesOf(key);
    if (values.length > 0) set({ [key]: values[(values.indexOf(state[key]) + 1) % values.length] });
}

// The address holds what differs from the defaults, in addition to the anchor that it may lead to.
const addressParts = () => [...new URLSearchParams(location.hash.slice(1))];
const anchors = () => addressParts().filter(([, value]) => !value).map(([name]) => name);
function readAddress() {
    set(Object.fromEntries(addressParts()), false);
    const target = byId(anchors()[0]);
    if (!target) return;
    for (const folded of [target, target.firstElementChild?.nextElementSibling]) if (folded?.tagName === "DETAILS") folded.open = true;
    if (target.hidden) showAllRows(target.closest("table"));
    target.scrollIntoView();
}
function writeAddress() {
    const changed = [...controls.keys()].filter((key) => state[key] !== defaults[key]).map((key) => [key, state[key]]);
    history.replaceState(null, "", `#${[...anchors(), String(new URLSearchParams(changed))].filter((part) => part).join("&")}`);
}

document.addEventListener("input", ({ target }) => {
    if (controls.has(target.name)) set({ [target.name]: target.value });
});
addEventListener("hashchange", readAddress);
// A toolbar that scrolls shows the whole of what has the focus
document.querySelector(".toolbar").addEventListener("focusin", ({ target }) => target.scrollIntoView({ block: "nearest", inline: "nearest" }));
