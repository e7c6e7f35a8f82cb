"use strict";
// Pixel values under the pointer, or under a cursor that arrow keys move. All images share the pixel.
(() => {
    const steps = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
    let column = null, row = null;
    const digits = (value) => String(Number(value.toPrecision(4)));

    // @param sources returns the images to read by their names; the error of the first against the second is stated
    page.addReadout = (stage, sources) => {
        const canvas = stage.firstElementChild;
        const cursor = document.createElement("i");
        cursor.className = "cursor";
        cursor.hidden = true;
        canvas.append(cursor);
        const output = document.createElement("output");
        output.className = "readout";
        output.setAttribute("aria-live", "polite");
        stage.parentElement.append(output);

        async function read(place) {
            const named = sources().filter(([, image]) => image);
            if (named.length === 0) return;
            const pixels = await Promise.all(named.map(([, image]) => page.pixelsOf(image)));
            const { width, height } = pixels[0];
            [column, row] = place(width, height);
            column = Math.min(width - 1, Math.max(0, column));
            row = Math.min(height - 1, Math.max(0, row));
            const at = row * width + column;
            const said = pixels.map(({ data, isExact }, i) => `${named[i][0]} ${[0, 1, 2].map((c) => digits(data[c * width * height + at])).join(" ")}${isExact ? "" : " (of 8 bits)"}`);
            if (pixels.length > 1) {
                const [shown, right] = pixels.map((image) => page.luminanceAt(image, at));
                if (right > 0) said.push(`luminance × ${digits(shown / right)}`);
            }
            output.textContent = [`x ${column}, y ${row}`, ...said].join(" · ");
            Object.assign(cursor.style, { left: `${(100 * (column + 0.5)) / width}%`, top: `${(100 * (row + 0.5)) / height}%` });
        }
        stage.addEventListener("pointermove", (event) => {
            const box = canvas.getBoundingClientRect();
            cursor.hidden = true;
            read((width, height) => [Math.floor(((event.clientX - box.left) / box.width) * width), Math.floor(((event.clientY - box.top) / box.height) * height)]);
        });
        stage.addEventListener("keydown", async (event) => {
            if (!(event.key in steps) || event.ctrlKey || event.metaKey || event.altKey) return;
            event.preventDefault();
            const [right, down] = steps[event.key].map((step) => step * (event.shiftKey ? 10 : 1));
            await read((width, height) => [(column ?? width >> 1) + right, (row ?? height >> 1) + down]);
            cursor.hidden = false;
            cursor.scrollIntoView({ block: "nearest", inline: "nearest", behavior: "instant" });
        });
        stage.addEventListener("blur", () => { cursor.hidden = true; });
    };
})();
