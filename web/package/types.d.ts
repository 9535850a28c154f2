// Types of the package alembert. What stands below the line is made from the program's own words.

/** Texts, or bytes where a file is no text, by name. */
export type Files = Record<string, string | Uint8Array>;

/** The text of a scene, or files of which one is the scene (the first that ends in .toml, if none is named). */
export type Scene = string | { readonly files: Readonly<Files>; readonly scene?: string };

/** Values of coordinates, rates and parameters: `{ theta: 0.3, "theta'": 1, m: "pi/2" }`. */
export type Values = Readonly<Record<string, number | string>> | string | readonly string[];

/** Ranges over which something varies: `{ l: [1, 9, 100] }` is FROM, TO, COUNT. */
export type Ranges = Readonly<Record<string, readonly number[] | string>> | string | readonly string[];

/** Options of every function. Those of the verb have the names of the command line: `maxStep` or `max_step` is --max-step. */
export interface Options {
    /** In a worker of its own, so that the caller's thread stays free. */
    worker?: boolean;
    /** Ends the work, which is then done in a worker. */
    signal?: AbortSignal;
}

export interface Warning {
    kind: string;
    message: string;
    line: number;
    name: string;
}

/** A field of a JSON object that is not described here; docs/commands.md has all. */
export type Json = Record<string, any>;

/** The JSON object of the verb. What it has written stands beside it, and is no part of the JSON. */
export type Result<T> = T & Json & {
    warnings: Warning[];
    /** The files that the verb has written, by name. */
    readonly written: Files;
    /** 0 done or proved, 1 refuted or unstable, 2 undecided. */
    readonly exitCode: 0 | 1 | 2;
    /** What the program said on its error stream: warnings. */
    readonly told: string;
};

export interface Derived {
    formalism: string;
    degrees_of_freedom: number;
    coordinates: string[];
    equations: { text: string; latex: string }[];
}

export type Verdict = "proved" | "refuted" | "undecided" | "vacuous";
export type Status = "right" | "right_near" | "right_up_to_constant" | "right_up_to_derivative" | "definition" | "mistake" | "follows"
    | "unfounded" | "undecided" | "not_understood" | "not_about_scene";

/** `claims` of equations, `lines` of a derivation. */
export interface Checked {
    claims?: { equation: string; line: number; verdict: Verdict; likely: { kind: string; term: string; repair?: string } | null }[];
    lines?: { line: number; column: number; source: string; claim: string; status: Status; right: string; follows_from: number | null; reason: string }[];
    first_mistake?: number | null;
    complete: boolean;
}

export interface Evaluated {
    time: number;
    coordinates: Record<string, number>;
    rates: Record<string, number>;
    accelerations: Record<string, number>;
    energy: number;
}

export interface Simulated {
    final: { time: number; coordinates: Record<string, number>; rates: Record<string, number> };
    method: string;
    steps: number;
    energy_drift: number | null;
}

export interface Stability {
    verdict: string;
    reason: string;
}

export interface Equilibria {
    equilibria: Json[];
}

export interface Agreed {
    formalisms: string[];
    verdict: Verdict;
}

/** The sources are `written`, by the names in `files`. */
export interface Emitted {
    files: string[];
    operations: number;
}

/** The page is `written[file]`. */
export interface Written {
    file: string;
}

export interface Diagnostic {
    file: string;
    line: number;
    column: number;
    message: string;
}

/** The program gave no result; `message` is what it prints. */
export class AlembertError extends Error {
    /** 3: the input is wrong; 4: the numbers failed; 5: the environment failed. */
    readonly code: 3 | 4 | 5;
    readonly diagnostics: Diagnostic[];
    /** What was calculated until then. */
    readonly result: Json | undefined;
    readonly written: Files;
}

export interface Answer {
    code: number;
    stdout: string;
    stderr: string;
    files: Files;
}

/** The command line: its words, and what its folder holds. */
export function run(words: readonly string[], files?: Files, more?: { folder?: string; folders?: readonly string[]; stdin?: Uint8Array | string | null }): Promise<Answer>;
/** Compiles the program before it is needed; from bytes or a module, where they are at hand. */
export function load(program?: BufferSource | WebAssembly.Module): Promise<WebAssembly.Module>;
/** Makes the instance of the next run in this thread now, where there is time, so that the run need not wait for it. */
export function prepare(): Promise<void>;
export const version: string;

/** All functions in a worker, until it is terminated. */
export function inWorker(): Promise<Verbs & {
    run(words: readonly string[], files?: Files, more?: { folder?: string; folders?: readonly string[]; stdin?: Uint8Array | string | null }): Promise<Answer>;
    terminate(): Promise<void>;
}>;

// --------------------------------------------------------------------------------------------------------------------
