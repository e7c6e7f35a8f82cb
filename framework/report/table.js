"use strict";
// Tables: a heading sorts by its column; the filter keeps rows, and what of their variants stands elsewhere on the page.
(() => {
    const toNumber = (key) => ({ inf: Infinity, "-inf": -Infinity })[key] ?? Number(key);

    // What has no value stays last.
    for (const button of document.querySelectorAll(".results thead button")) {
        button.addEventListener("click", () => {
            const heading = button.closest("th");
            const index = heading.cellIndex;
            const direction = heading.getAttribute("aria-sort") === "ascending" ? -1 : 1;
            const isNumeric = button.hasAttribute("data-numeric");
            const body = button.closest("table").tBodies[0];
            const keyed = [...body.rows].map((row) => ({ row, key: row.cells[index].dataset.sort ?? "" }));
            const compare = ({ key: x }, { key: y }) => {
                if (!x || !y) return (x ? 0 : 1) - (y ? 0 : 1);
                if (!isNumeric) return direction * x.localeCompare(y);
                const [p, q] = [toNumber(x), toNumber(y)];
                return p === q ? 0 : direction * (p < q ? -1 : 1);
            };
            body.append(...keyed.sort(compare).map(({ row }) => row));
            page.showRows?.();
            for (const other of heading.parentElement.cells) other.removeAttribute("aria-sort");
            heading.setAttribute("aria-sort", direction > 0 ? "ascending" : "descending");
        });
    }

    const table = document.querySelector("#results .results");
    const count = document.querySelector(".filter output");
    if (!table || !count) return;
    const rows = [...table.tBodies[0].rows];
    const textOf = new Map();
    const numberOf = (id) => id.slice(id.lastIndexOf("-") + 1);

    // What leads to a variant or shows it, by the number of its row.
    const elsewhere = new Map();
    for (const element of document.querySelectorAll(".thumbnail, article[id]")) {
        const number = numberOf(element.id || element.getAttribute("href"));
        elsewhere.set(number, [...(elsewhere.get(number) ?? []), element]);
    }

    // The column that a word names: the first one in sight whose heading holds it.
    function columnOf(name) {
        const headings = [...table.tHead.rows[0].cells];
        return headings.findIndex((heading) => heading.offsetParent && heading.textContent.toLowerCase().includes(name));
    }
    const isTrue = { "<": (a, b) => a < b, ">": (a, b) => a > b, "<=": (a, b) => a <= b, ">=": (a, b) => a >= b, "=": (a, b) => a === b };

    // A word is a comparison with a column, or stands in the row's text.
    function testOf(word) {
        const [, name, relation, number] = /^([^<>=]+)(<=|>=|<|>|=)(-?[\d.]+(?:e[+-]?\d+)?)$/.exec(word) ?? [];
        const column = name ? columnOf(name) : -1;
        if (column >= 0) {
            return (row) => {
                const key = row.cells[column].dataset.sort ?? "";
                return key !== "" && isTrue[relation](toNumber(key), Number(number));
            };
        }
        return (row) => {
            if (!textOf.has(row)) textOf.set(row, row.textContent.toLowerCase());
            return textOf.get(row).includes(word);
        };
    }

    // Of the rows that are kept the first ones in order, as many as are laid out fast, until all are asked for.
    const button = document.querySelector(".filter button");
    let limit = Number(table.dataset.rows);
    page.showRows = () => {
        const tests = page.state.filter.toLowerCase().split(/\s+/).filter((word) => word).map(testOf);
        let kept = 0;
        page.matching = new Set();
        for (const row of [...table.tBodies[0].rows]) {
            const isKept = tests.every((test) => test(row));
            kept += isKept;
            if (isKept) page.matching.add(numberOf(row.id));
            row.hidden = !isKept || kept > limit;
            for (const element of elsewhere.get(numberOf(row.id)) ?? []) element.classList.toggle("filtered", !isKept);
        }
        button.hidden = kept <= limit;
        const first = button.hidden ? "" : `, the first ${limit} in the table`;
        count.textContent = tests.length || first ? `${kept} of ${rows.length} variants${first}` : "";
    };
    page.showAllRows = () => {
        limit = Infinity;
        page.showRows();
    };
    button.addEventListener("click", page.showAllRows);
    page.onChange(["filter", "light"], page.showRows);
})();
