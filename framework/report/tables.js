"use strict";
// What all charts and tables of a page share: numbers as text, elements, files to save, tables that sort.

function figures(value, digits = 3) {
    if (typeof value !== "number") return value ?? "–";
    const size = Math.abs(value);
    return d3.format(value === 0 ? "d" : size < 1e-4 || size >= 1e6 ? `.${digits - 1}~e` : `,.${digits}~r`)(value).replace("−", "-");
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

const csvOf = (rows) => rows.map((row) => row.map((value) =>
    /[",\n]/.test(value ?? "") ? `"${String(value).replaceAll('"', '""')}"` : value ?? "").join(",") + "\n").join("");

// A folded table. `content()` gives {head, rows} where it is unfolded or saved; rows beyond the first ones are shown on request.
function foldedTable(title, note, content, most = 300) {
    const body = element("div", { class: "scroll", tabindex: "0", role: "region", "aria-label": title });
    const all = element("button", { type: "button", onclick: () => show(Infinity) });
    const csv = element("button", { type: "button", onclick: () => {
        const { head, rows } = content();
        save(`${title.toLowerCase().replace(/[^a-z0-9]+/g, "-")}.csv`, "text/csv", csvOf([head, ...rows]));
    } }, "Save as CSV");
    const folded = element("details", { class: "folded" }, element("summary", {}, title), element("p", { class: "note" }, note),
                           element("p", { class: "filter" }, csv, all), body);
    let sorted = { column: -1, direction: 1 };

    function compare(x, y) {
        const [p, q] = [x[sorted.column], y[sorted.column]];
        if (typeof p !== typeof q || p === null || q === null) return typeof p === "number" ? -1 : typeof q === "number" ? 1 : 0;
        return sorted.direction * (typeof p === "number" ? p - q : String(p).localeCompare(q));
    }
    function show(limit = most) {
        if (!folded.open) return;
        const { head, rows } = content();
        const ordered = sorted.column < 0 ? rows : [...rows].sort(compare);
        const headings = head.map((name, column) => element("th", {
            scope: "col", class: typeof rows[0]?.[column] === "string" && "words", "aria-sort": column === sorted.column && (sorted.direction > 0 ? "ascending" : "descending"),
        }, element("button", { type: "button", onclick: () => {
            sorted = { column, direction: column === sorted.column ? -sorted.direction : 1 };
            show(limit);
            body.querySelectorAll("th button")[column].focus();
        } }, name)));
        body.replaceChildren(element("table", { class: "results" }, element("thead", {}, element("tr", {}, ...headings)),
            element("tbody", {}, ...ordered.slice(0, limit).map((row) => element("tr", {}, ...row.map((value) =>
                element("td", typeof value === "string" ? { class: "words" } : {}, String(figures(value)))))))));
        all.textContent = `Show all ${rows.length} rows`;
        all.hidden = rows.length <= limit;
    }
    folded.addEventListener("toggle", () => show());
    return { folded, show };
}
