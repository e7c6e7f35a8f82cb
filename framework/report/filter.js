// The filter keeps rows of the results, and what of their variants stands elsewhere on the page.

const resultsTable = document.querySelector("#results .results");
const numberOf = (id) => id.slice(id.lastIndexOf("-") + 1);
const isTrue = { "<": (a, b) => a < b, ">": (a, b) => a > b, "<=": (a, b) => a <= b, ">=": (a, b) => a >= b, "=": (a, b) => a === b };
const rowText = new Map();
let matching = null; // numbers of the variants that are kept; null: all

// A word is a comparison with a column, the first one in sight whose heading holds its name, or stands in the row's text.
function testOf(word) {
    const [, name, relation, number] = /^([^<>=]+)(<=|>=|<|>|=)(-?[\d.]+(?:e[+-]?\d+)?)$/.exec(word) ?? [];
    const headings = [...resultsTable.tHead.rows[0].cells];
    const column = name ? headings.findIndex((heading) => heading.offsetParent && heading.textContent.toLowerCase().includes(name)) : -1;
    if (column >= 0) {
        return (row) => {
            const key = keyOf(row.cells[column]);
            return !isEmpty(key) && isTrue[relation](toNumber(key), Number(number));
        };
    }
    return (row) => {
        if (!rowText.has(row)) rowText.set(row, row.textContent.toLowerCase());
        return rowText.get(row).includes(word);
    };
}

if (document.querySelector(".filter output")) {
    // What leads to a variant or shows it, by the number of its row
    const elsewhere = new Map();
    for (const part of document.querySelectorAll('#images .copy:not([href="#reference"]), article[id]')) {
        const number = numberOf(part.id || part.getAttribute("href"));
        elsewhere.set(number, [...(elsewhere.get(number) ?? []), part]);
    }
    onChange(["filter", "light"], () => {
        const tests = state.filter.toLowerCase().split(/\s+/).filter((word) => word).map(testOf);
        matching = new Set();
        filters.set(resultsTable, (row) => {
            const isKept = tests.every((test) => test(row));
            if (isKept) matching.add(numberOf(row.id));
            return isKept;
        });
        const kept = showRows(resultsTable);
        for (const [number, parts] of elsewhere) {
            for (const part of parts) part.classList.toggle("filtered", !matching.has(number));
        }
        document.querySelector(".filter output").textContent = tests.length ? `${kept} of ${resultsTable.tBodies[0].rows.length} variants` : "";
    });
}
