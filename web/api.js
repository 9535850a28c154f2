// The program as a function. Every run is a process of its own: a new instance of the module, which is compiled once.

let program = null, next = null;

/// What Node alone has: no literal, so that bundlers for browsers do not look for it.
const of_node = (name) => import(/* @vite-ignore */ /* webpackIgnore: true */ `node:${name}`);

/// Loads and compiles alembert.wasm, which stands beside this file. `run` does it where nobody has.
export function load(bytes) {
    program ??= compiled(bytes);
    return program;
}

async function compiled(bytes) {
    if (bytes instanceof WebAssembly.Module) return bytes;
    if (bytes) return WebAssembly.compile(bytes);
    const place = new URL("./alembert.wasm", import.meta.url);
    if (place.protocol === "file:") {
        const { readFile } = await of_node("fs/promises");
        return WebAssembly.compile(await readFile(place));
    }
    const answer = await fetch(place);
    if (!answer.ok) throw new Error(`${place}: ${answer.status} ${answer.statusText}`);
    if (answer.headers.get("content-type") === "application/wasm")
        return WebAssembly.compileStreaming(answer);
    return WebAssembly.compile(await answer.arrayBuffer());
}

/// An instance that has not run yet, with its streams.
async function fresh() {
    const module = await load();
    const streams = { out: collector(), err: collector(), read: () => null };
    const instance = await started({
        instantiateWasm(imports, done) {
            WebAssembly.instantiate(module, imports).then((instance) => done(instance, module));
            return {};
        },
        preRun(own) {
            own.FS.init(() => streams.read(), (byte) => streams.out.put(byte), (byte) => streams.err.put(byte));
        },
    });
    return { instance, streams };
}

/// Makes the instance of the next run now, where there is time, so that the run need not wait for it.
export async function prepare() {
    next ??= fresh();
    await next;
}

/// Collects the bytes of a stream.
function collector() {
    let bytes = new Uint8Array(1 << 12), size = 0;
    return {
        put(byte) {
            if (size === bytes.length) {
                const more = new Uint8Array(2 * size);
                more.set(bytes);
                bytes = more;
            }
            bytes[size++] = byte;
        },
        text: () => new TextDecoder().decode(bytes.subarray(0, size)),
    };
}

function write_files(FS, here, files) {
    for (const [name, content] of Object.entries(files)) {
        const path = name.startsWith("/") ? name : `${here}/${name}`;
        FS.mkdirTree(path.slice(0, path.lastIndexOf("/")) || "/");
        FS.writeFile(path, content);
    }
}

/// All files below a folder with their bytes, by their names from `here`, or by their paths if they are elsewhere.
function files_below(FS, folder, here, found = new Map()) {
    for (const name of FS.readdir(folder || "/")) {
        const path = `${folder}/${name}`;
        if (name === "." || name === ".." || path === "/dev" || path === "/proc") continue;
        if (FS.isDir(FS.stat(path).mode)) files_below(FS, path, here, found);
        else found.set(path.startsWith(`${here}/`) ? path.slice(here.length + 1) : path, FS.readFile(path));
    }
    return found;
}

/// Gives the bytes of a text one after the other, and then null.
function reader(input) {
    const bytes = typeof input === "string" ? new TextEncoder().encode(input) : input ?? [];
    let next = 0;
    return () => (next < bytes.length ? bytes[next++] : null);
}

function as_text(bytes) {
    try {
        return new TextDecoder("utf-8", { fatal: true }).decode(bytes);
    } catch {
        return bytes; // an archive, for instance
    }
}

/// The program with these arguments, as on a command line, in a folder that holds `files`: text (or bytes) by name.
/// Gives the exit code, the two streams, and the files that it has written or changed: text, or bytes where they are
/// none.
///
///     const { code, stdout } = await run(["derive", "scene.toml", "--json"], { "scene.toml": text });
///
/// `folder` is the path of the command's folder, from which the names in `words` count, `folders` are others that are
/// there too, and `stdin` is a text (or bytes). Files that are written outside of the folder are given by their paths.
export async function run(words, files = {}, { folder = "/scene", folders = [], stdin = null } = {}) {
    const own = next ?? fresh();
    next = null;
    const { instance, streams } = await own, { out, err } = streams, { FS } = instance;
    streams.read = reader(stdin);
    for (const path of [folder, ...folders]) FS.mkdirTree(path);
    FS.chdir(folder);
    write_files(FS, folder, files);
    const before = files_below(FS, "", folder);
    let code = 5;
    try {
        code = instance.callMain([...words]);
    } catch (end) {
        if (end?.name === "ExitStatus") code = end.status;
        else for (const byte of new TextEncoder().encode(`alembert: ${end?.message ?? end}\n`)) err.put(byte);
    }
    const changed = {};
    for (const [name, bytes] of files_below(FS, "", folder)) {
        const old = before.get(name);
        if (!old || old.length !== bytes.length || old.some((byte, k) => byte !== bytes[k]))
            changed[name] = as_text(bytes);
    }
    return { code, stdout: out.text(), stderr: err.text(), files: changed };
}
