// Runs the program in a worker, so that the page stays responsive.

// The bytes of the module, which is compressed and in base64.
async function moduleBytes() {
    const text = atob(document.getElementById("module").textContent);
    const packed = new Blob([Uint8Array.from(text, (letter) => letter.charCodeAt(0))]);
    return new Response(packed.stream().pipeThrough(new DecompressionStream("gzip"))).arrayBuffer();
}

class Program {
    constructor() {
        const source = new Blob([document.getElementById("worker").textContent], { type: "text/javascript" });
        this.worker = new Worker(URL.createObjectURL(source));
        this.waiting = new Map();
        this.count = 0;
        this.worker.onmessage = ({ data }) => this.receive(data);
        this.ready = moduleBytes().then((module) => this.worker.postMessage({ module }));
    }

    receive({ id, progress, failed, ...result }) {
        const call = this.waiting.get(id);
        if (progress !== undefined) return call.progress(progress);
        this.waiting.delete(id);
        if (failed) call.reject(new Error(failed));
        else call.resolve(result);
    }

    // Runs the program with these arguments; `input` is text or a Blob. Resolves to the status and the Blobs `output` and
    // `errors`.
    async run(args, input, progress = () => {}) {
        await this.ready;
        const id = this.count++;
        return new Promise((resolve, reject) => {
            this.waiting.set(id, { resolve, reject, progress });
            this.worker.postMessage({ id, args, input: new Blob([input]) });
        });
    }

    // The rows that a command adds its columns to, each as an object of texts; a failure is thrown in the program's words.
    async rows(args, table) {
        const { status, output, errors } = await this.run([...args, "-", "--format", "csv", "--decimal", "point"], table);
        if (status > 1) throw new Error((await errors.text()).trim().split("\n").at(-1));
        const [names, ...rows] = cells(await output.text());
        return rows.map((row) => Object.fromEntries(names.map((name, k) => [name, row[k]])));
    }
}

// The cells of what the program writes, with commas and, where a cell needs them, quotes.
function cells(text) {
    const cell = /(?:"((?:[^"]|"")*)"|([^,\n]*))(,|\n|$)/y;
    const rows = [[]];
    while (cell.lastIndex < text.length) {
        const [, quoted, plain, end] = cell.exec(text);
        rows.at(-1).push(quoted === undefined ? plain : quoted.replaceAll('""', '"'));
        if (end !== ",") rows.push([]);
    }
    return rows.filter((row) => row.length > 0);
}

const program = new Program();
