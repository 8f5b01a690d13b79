// Runs the program: a WebAssembly module that reads standard input and writes standard output, as WASI defines it.
"use strict";

// Error numbers of WASI.
const SUCCESS = 0, BAD_FILE = 8, NO_SUCH_FUNCTION = 52;
// Bytes of the input that are read at once, and of the output that are kept in one piece.
const PIECE = 1 << 20;

class Exit extends Error {
    constructor(status) {
        super();
        this.status = status;
    }
}

// Standard input from a Blob, piece by piece.
class Input {
    constructor(blob, progress) {
        Object.assign(this, { blob, progress, at: 0, piece: new Uint8Array(), reader: new FileReaderSync() });
    }

    // Copies what is next into `room`; the number of bytes.
    read(room) {
        if (this.piece.length === 0 && this.at < this.blob.size) {
            this.piece = new Uint8Array(this.reader.readAsArrayBuffer(this.blob.slice(this.at, this.at + PIECE)));
            this.at += this.piece.length;
            this.progress(this.at / this.blob.size);
        }
        const given = this.piece.subarray(0, room.length);
        room.set(given);
        this.piece = this.piece.subarray(given.length);
        return given.length;
    }
}

// A stream that is written, collected as a Blob.
class Output {
    constructor() {
        Object.assign(this, { parts: [], piece: new Uint8Array(PIECE), used: 0 });
    }

    write(bytes) {
        for (let at = 0; at < bytes.length;) {
            if (this.used === PIECE) this.flush();
            const taken = bytes.subarray(at, at + PIECE - this.used);
            this.piece.set(taken, this.used);
            this.used += taken.length;
            at += taken.length;
        }
    }

    flush() {
        this.parts.push(new Blob([this.piece.subarray(0, this.used)]));
        this.used = 0;
    }

    blob() {
        this.flush();
        return new Blob(this.parts, { type: "text/csv" });
    }
}

// Runs the program once with these arguments and this Blob as standard input.
function run(module, args, blob, progress) {
    const input = new Input(blob, progress), output = new Output(), errors = new Output();
    const texts = ["microimpact", ...args].map((text) => new TextEncoder().encode(text + "\0"));
    let memory;
    const view = () => new DataView(memory.buffer);
    const bytes = (at, length) => new Uint8Array(memory.buffer, at, length);
    // The rooms of a list of pointers and lengths.
    const rooms = (at, count) => Array.from({ length: count }, (_, k) =>
        bytes(view().getUint32(at + 8 * k, true), view().getUint32(at + 8 * k + 4, true)));
    const set = (at, number) => {
        view().setUint32(at, number, true);
        return SUCCESS;
    };
    const system = {
        args_sizes_get: (count, size) => set(count, texts.length) || set(size, texts.reduce((sum, text) => sum + text.length, 0)),
        args_get(pointers, at) {
            for (const [k, text] of texts.entries()) {
                set(pointers + 4 * k, at);
                bytes(at, text.length).set(text);
                at += text.length;
            }
            return SUCCESS;
        },
        environ_sizes_get: (count, size) => set(count, 0) || set(size, 0),
        environ_get: () => SUCCESS,
        random_get(at, length) {
            crypto.getRandomValues(bytes(at, length));
            return SUCCESS;
        },
        clock_time_get(_clock, _precision, at) {
            view().setBigUint64(at, BigInt(Math.round(performance.now() * 1e6)), true);
            return SUCCESS;
        },
        fd_read(file, at, count, read) {
            if (file !== 0) return BAD_FILE;
            const room = rooms(at, count).find((room) => room.length > 0);
            return set(read, room ? input.read(room) : 0);
        },
        fd_write(file, at, count, written) {
            const stream = [undefined, output, errors][file];
            if (!stream) return BAD_FILE;
            const given = rooms(at, count);
            given.forEach((piece) => stream.write(piece));
            return set(written, given.reduce((sum, piece) => sum + piece.length, 0));
        },
        // No file is open but the streams.
        fd_prestat_get: () => BAD_FILE,
        fd_close: () => SUCCESS,
        proc_exit(status) {
            throw new Exit(status);
        },
    };
    const others = { get: (known, name) => known[name] ?? (() => NO_SUCH_FUNCTION) };
    const instance = new WebAssembly.Instance(module, { wasi_snapshot_preview1: new Proxy(system, others) });
    memory = instance.exports.memory;
    let status = 0;
    try {
        instance.exports._start();
    } catch (error) {
        if (!(error instanceof Exit)) throw error;
        status = error.status;
    }
    return { status, output: output.blob(), errors: errors.blob() };
}

let module;
onmessage = async ({ data }) => {
    if (data.module) {
        module = WebAssembly.compile(data.module);
        return;
    }
    const { id, args, input } = data;
    try {
        const progress = (fraction) => postMessage({ id, progress: fraction });
        postMessage({ id, ...run(await module, args, input, progress) });
    } catch (error) {
        postMessage({ id, failed: String(error) });
    }
};
