// Pixel values under the pointer, or under a cursor that arrow keys move. All images share the pixel.

const cursorSteps = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
let column = null, row = null;
const digits = (value) => String(Number(value.toPrecision(4)));

// @param sources returns names and images to read; the ratio of the first two luminances is stated
function addReadout(stage, sources) {
    const canvas = stage.firstElementChild;
    const cursor = element("i", { class: "cursor", hidden: "" }), output = element("output", { class: "readout", "aria-live": "polite" });
    canvas.append(cursor);
    stage.parentElement.append(output);

    async function read(pixelOf) {
        const named = sources().filter(([, image]) => image);
        if (named.length === 0) return;
        const all = await Promise.all(named.map(([, image]) => pixelsOf(image)));
        const { width, height } = all[0];
        [column, row] = pixelOf(width, height);
        column = Math.min(width - 1, Math.max(0, column));
        row = Math.min(height - 1, Math.max(0, row));
        const readings = all.map((pixels, i) => {
            const index = indexIn(pixels, all[0], row * width + column), { data: planes, isExact } = pixels;
            const color = [0, 1, 2].map((c) => digits(planes[(c * planes.length) / 3 + index]));
            return { text: `${named[i][0]} ${color.join(" ")}${isExact ? "" : " (8 bits)"}`, luminance: luminanceAt(pixels, index) };
        });
        const ratio = readings[0].luminance / readings[1]?.luminance;
        output.textContent = [`x ${column}, y ${row}`, ...readings.map(({ text }) => text),
                              ...(isFinite(ratio) ? [`luminance × ${digits(ratio)}`] : [])].join(" · ");
        Object.assign(cursor.style, { left: `${(100 * (column + 0.5)) / width}%`, top: `${(100 * (row + 0.5)) / height}%` });
    }
    stage.addEventListener("pointermove", (event) => {
        const box = canvas.getBoundingClientRect();
        cursor.hidden = true;
        const across = (event.clientX - box.left) / box.width, down = (event.clientY - box.top) / box.height;
        read((width, height) => [Math.floor(across * width), Math.floor(down * height)]);
    });
    stage.addEventListener("keydown", async (event) => {
        if (!(event.key in cursorSteps) || event.ctrlKey || event.metaKey || event.altKey) return;
        event.preventDefault();
        const [right, down] = cursorSteps[event.key].map((step) => step * (event.shiftKey ? 10 : 1));
        await read((width, height) => [(column ?? width >> 1) + right, (row ?? height >> 1) + down]);
        cursor.hidden = false;
        cursor.scrollIntoView({ block: "nearest", inline: "nearest", behavior: "instant" });
    });
    stage.addEventListener("blur", () => { cursor.hidden = true; });
}
