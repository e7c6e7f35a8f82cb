// What all pages share: numbers as text, elements, files to save, images in a row, tables that sort.

const data = JSON.parse(document.getElementById("data").textContent);
const byId = (id) => document.getElementById(id);

// Three significant digits, without zeros at the end
function figures(value) {
    if (typeof value !== "number") return value ?? "–";
    const size = Math.abs(value);
    return d3.format(value === 0 ? "d" : size < 1e-4 || size >= 1e6 ? ".2~e" : ",.3~r")(value).replace("−", "-");
}

function element(tag, attributes = {}, ...children) {
    const made = document.createElement(tag);
    for (const [name, value] of Object.entries(attributes)) {
        if (name.startsWith("on")) made.addEventListener(name.slice(2), value);
        else if (value !== undefined && value !== false) made.setAttribute(name, value);
    }
    made.append(...children);
    return made;
}

function save(name, kind, text) {
    const link = element("a", { download: name, href: URL.createObjectURL(new Blob([text], { type: kind })) });
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}

// Images with their captions and what a screen reader says of them, of [address, caption, words]; those without an address are left out.
const strip = (images) => images.filter(([uri]) => uri).map(([uri, caption, words]) =>
    element("figure", {}, element("img", { src: uri, alt: words }), element("figcaption", {}, caption)));

// --- Tables, of this script's or the page's. A heading sorts by its column; what has no value stays last.

const keyOf = (cell) => cell.dataset.sort ?? cell.textContent;
const toNumber = (key) => ({ inf: Infinity, "-inf": -Infinity })[key] ?? Number(key);
const isEmpty = (key) => ["", "–", "none"].includes(key);

function sortBy(heading) {
    const table = heading.closest("table"), direction = heading.getAttribute("aria-sort") === "ascending" ? -1 : 1;
    const keyed = [...table.tBodies[0].rows].map((row) => ({ row, key: keyOf(row.cells[heading.cellIndex]) }));
    const isNumeric = keyed.every(({ key }) => isEmpty(key) || !Number.isNaN(toNumber(key)));
    const compare = ({ key: x }, { key: y }) => {
        if (isEmpty(x) || isEmpty(y)) return isEmpty(x) - isEmpty(y);
        if (!isNumeric) return direction * x.localeCompare(y);
        const [p, q] = [toNumber(x), toNumber(y)];
        return p === q ? 0 : direction * (p < q ? -1 : 1);
    };
    table.tBodies[0].append(...keyed.sort(compare).map(({ row }) => row));
    for (const other of heading.parentElement.cells) other.removeAttribute("aria-sort");
    heading.setAttribute("aria-sort", direction > 0 ? "ascending" : "descending");
    showRows(table);
}

// Of the rows that the table's filter keeps the first ones, as many as are laid out fast, until all are asked for.
const filters = new Map(); // by table
function showRows(table) {
    const keeps = filters.get(table) ?? (() => true), most = Number(table.dataset.rows ?? Infinity);
    let kept = 0;
    for (const row of table.tBodies[0].rows) {
        const isKept = keeps(row);
        kept += isKept;
        row.hidden = !isKept || kept > most;
    }
    const all = table.closest("section, details").querySelector(".all-rows");
    if (all) all.hidden = kept <= most;
    return kept;
}
function showAllRows(table) {
    delete table.dataset.rows;
    showRows(table);
}

const csvOf = (table) => [...table.rows].map((row) => [...row.cells].map((cell) => {
    const value = isEmpty(keyOf(cell)) ? "" : keyOf(cell);
    return /[",\n]/.test(value) ? `"${value.replaceAll('"', '""')}"` : value;
}).join(",") + "\n").join("");

document.addEventListener("click", ({ target }) => {
    const folded = target.closest("section, details"), table = folded?.querySelector("table");
    if (target.matches("th[scope=col] button")) sortBy(target.closest("th"));
    else if (target.matches(".all-rows")) showAllRows(table);
    else if (target.matches(".save")) {
        save(`${folded.querySelector("summary").textContent.toLowerCase().replace(/[^a-z0-9]+/g, "-")}.csv`, "text/csv", csvOf(table));
    }
});

// A folded table (macros.html.j2) whose rows are made where it is unfolded. Returns a function that makes them anew.
function fillFolded(folded, rowsOf) {
    const table = folded.querySelector("table");
    const cellOf = (value) => element("td", typeof value === "string" ? { class: "words" } : { "data-sort": value ?? "none" }, String(figures(value)));
    function show() {
        if (!folded.open) return;
        table.dataset.rows = 300; // of thousands
        table.tBodies[0].replaceChildren(...rowsOf().map((row) => element("tr", {}, ...row.map(cellOf))));
        showRows(table);
    }
    folded.addEventListener("toggle", show);
    return show;
}
