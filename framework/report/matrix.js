// A matrix of methods by scenes, colored on both sides of 1, on a logarithmic scale.

const styleValue = (name) => getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
const mostFold = Number(styleValue("most-fold")); // at which colors are strongest
const foldColor = d3.scaleLinear([-1, -0.5, 0, 0.5, 1], d3.range(5).map((i) => styleValue(`f${i}`))).interpolate(d3.interpolateLab).clamp(true);
const colorOf = (factor) => foldColor(Math.log(factor) / Math.log(mostFold));
const factorText = (factor) => (factor > 0 && factor < 0.1 ? `1/${factorText(1 / factor)}` : d3.format(factor === 0 ? "d" : factor >= 1e4 ? ".1e" : ",.2r")(factor));
const inkOn = (color) => (d3.lab(color).l > 62 ? "#111" : "#fff");

// columns: names. rows: [{name, title, swatch, total, cells}]; a cell is {text, css, small, fold}, fold being what its color shows, null
// for none. tell(row, column) is what a cell says in words; onPick(row, column) is called by a click or Enter, onPoint likewise by pointer
// and arrow keys.
function drawMatrix(host, { columns, rows, totalName, tell, onPick, onPoint }) {
    const cells = rows.map((row, r) => row.cells.map(({ text, css, small, fold = null }, c) => {
        const made = element("td", { role: "gridcell", tabindex: "-1", "aria-label": tell(r, c), class: css }, text, ...(small ? [element("small", {}, small)] : []));
        if (fold !== null) Object.assign(made.style, { backgroundColor: colorOf(fold), color: inkOn(colorOf(fold)) });
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
    const head = element("tr", {}, element("th"), ...[...columns, totalName].map((name) => element("th", { scope: "col" }, element("span", {}, name))));
    const body = rows.map((row, r) => element("tr", {}, element("th", { scope: "row", title: row.title }, row.swatch ?? "", row.name), ...cells[r],
                                              element("td", { class: "total" }, row.total)));
    host.replaceChildren(element("thead", {}, head), element("tbody", {}, ...body));
    if (cells.length) reach(0, 0, false);
}

// The scale of colors, as a bar with its ends and 1.
function drawScale(host, [low, high] = [`1/${mostFold}`, mostFold]) {
    const pieces = d3.range(-1, 1.01, 0.125).map((step) => element("i", { style: `background: ${foldColor(step)}` }));
    host.replaceChildren(element("span", {}, low), ...pieces, element("span", {}, high));
}
