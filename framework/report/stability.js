// The page of `voxray stability`: a heat map of methods by scenes, and the images of the cell under the pointer or the keyboard's.

const markOf = { holds: "", fails: "✗", undecided: "?", noise: "~" };
const cellAt = (r, c) => data.rows[r].cells[c];
const tellCell = (r, c) => cellAt(r, c)?.words ?? `${data.rows[r].name} in ${data.scenes[c]}: not measured.`;

function heatCell(cell) {
    if (!cell) return { text: "", css: "empty" };
    const text = cell.over === null ? "" : cell.over < 0.1 ? "<.1" : cell.over > 99 ? ">99" : factorText(cell.over); // null: it does not run
    return { text: `${markOf[cell.verdict]}${text}`, css: cell.verdict, fold: cell.verdict === "noise" ? null : 1 / (cell.over ?? Infinity) };
}
function showCell(r, c) {
    byId("cell").textContent = tellCell(r, c);
    const [truth, picture] = (cellAt(r, c)?.images ?? []).map((i) => data.pictures[i]);
    const name = `${data.rows[r].name}, ${data.scenes[c]}`;
    byId("cell-images").replaceChildren(...strip([[truth, "what it should show", `what should be shown: ${name}`],
                                                  [picture, "what it shows", `what is shown: ${name}`]]));
}

drawScale(byId("scale"), [`${mostFold} times its limit`, `1/${mostFold}`]);
drawMatrix(byId("matrix"), {
    columns: data.scenes, totalName: "fails in", tell: tellCell, onPoint: showCell, onPick: showCell,
    rows: data.rows.map(({ name, cells }) => {
        const measured = cells.filter((cell) => cell), failing = measured.filter(({ verdict }) => verdict === "fails");
        return { name, cells: cells.map(heatCell), total: `${failing.length}/${measured.length}` };
    }),
});
