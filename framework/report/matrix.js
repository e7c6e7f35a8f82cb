"use strict";
// A matrix of factors: rows by columns, colored on both sides of 1.

const mostFold = 16; // at which colors are strongest
const foldColor = d3.scaleLinear([-1, -0.5, 0, 0.5, 1], ["#b35806", "#f5a859", "#f4f4f4", "#8db7dc", "#1f5a9c"]).interpolate(d3.interpolateLab).clamp(true);
const colorOf = (factor) => foldColor(Math.log(factor) / Math.log(mostFold));
const isOpen = ([, low, high]) => low <= 1 && (high === null || high >= 1);
const factorText = (factor) => d3.format(factor === 0 ? "d" : factor < 0.01 || factor >= 1e4 ? ".1e" : ",.2r")(factor);
const inkOn = (color) => (d3.lab(color).l > 62 ? "#111" : "#fff");

// columns: names; counts: of errors in each. rows: [{name, title, swatch, isSelf, cells: [null | 0 | [value, low, high, reached]], total}]. tell(row, column) is what a
// cell says in words; onPick(row, column) is called by a click or Enter, onPoint likewise by pointer and arrow keys.
function drawMatrix(host, { columns, counts, rows, totalName, tell, onPick, onPoint }) {
    const best = columns.map((_, c) => d3.max(rows, ({ cells }) => (cells[c] && 2 * cells[c][3] >= counts[c] ? cells[c][0] : 0)));
    const cells = rows.map((row, r) => row.cells.map((cell, c) => {
        const made = element("td", { role: "gridcell", tabindex: "-1", "aria-label": tell(r, c) });
        made.className = !cell ? "empty" : isOpen(cell) && !row.isSelf ? "open" : "";
        made.textContent = cell ? factorText(cell[0]) : cell === 0 ? "–" : "";
        if (cell && cell[3] < counts[c]) made.append(element("small", {}, `${cell[3]}/${counts[c]}`));
        made.classList.toggle("best", Boolean(cell) && cell[0] === best[c]);
        if (cell) made.style.backgroundColor = colorOf(cell[0]);
        if (cell) made.style.color = inkOn(colorOf(cell[0]));
        made.addEventListener("click", () => onPick(r, c));
        made.addEventListener("pointerenter", () => onPoint(r, c));
        made.addEventListener("focus", () => onPoint(r, c));
        made.addEventListener("keydown", (event) => {
            const step = { ArrowLeft: [0, -1], ArrowRight: [0, 1], ArrowUp: [-1, 0], ArrowDown: [1, 0], Home: [0, -c], End: [0, columns.length - 1 - c] }[event.key];
            if (event.key === "Enter" || event.key === " ") onPick(r, c);
            else if (!step) return;
            else reach(Math.min(rows.length - 1, Math.max(0, r + step[0])), Math.min(columns.length - 1, Math.max(0, c + step[1])));
            event.preventDefault();
        });
        return made;
    }));
    // One cell is in the order of the Tab key; arrow keys move to others
    function reach(r, c, focus = true) {
        for (const cell of cells.flat()) cell.tabIndex = -1;
        cells[r][c].tabIndex = 0;
        if (focus) cells[r][c].focus();
    }
    const head = element("tr", {}, element("th"), ...columns.map((name) => element("th", { scope: "col" }, name)), element("th", { scope: "col" }, totalName));
    const body = rows.map((row, r) => element("tr", {}, element("th", { scope: "row", title: row.title }, row.swatch, row.name), ...cells[r],
                                              element("td", { class: "total" }, row.total === null ? "–" : factorText(row.total))));
    host.replaceChildren(element("thead", {}, head), element("tbody", {}, ...body));
    if (cells.length) reach(0, 0, false);
}

// The scale of colors, as a bar with its ends and 1.
function drawScale(host) {
    const steps = d3.range(-1, 1.01, 0.125);
    host.replaceChildren(element("span", {}, `1/${mostFold}`), ...steps.map((step) => {
        const piece = element("i");
        piece.style.backgroundColor = foldColor(step);
        return piece;
    }), element("span", {}, `${mostFold}`));
}
