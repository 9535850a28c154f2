// SPDX-License-Identifier: MIT
// What the page says, in English and Chinese. Texts about scenes are the program's own.

export const strings = {
    scene: ["Scene", "场景"],
    derivation: ["Derivation", "推导"],
    result: ["Result", "结果"],
    example: ["Example", "示例"],
    share: ["Share link", "分享链接"],
    copied: ["Link copied", "链接已复制"],
    shown: ["The link stands in the address bar", "链接在地址栏中"],
    save: ["Save", "保存"],
    language: ["中文", "English"],
    title: ["alembert: mechanics you can check", "alembert：可以验证的力学"],
    loading: ["Loading the program …", "正在载入程序……"],
    starting: ["Deriving …", "正在推导……"],
    working: ["Working …", "正在计算……"],
    stop: ["Stop", "停止"],
    stopped: ["Stopped. It goes on when you change the text.", "已停止。修改文字后会继续。"],
    ready: ["Up to date", "已更新"],
    faults: ["{n} to mend", "{n} 处需修改"],
    stale: ["The page shows the last scene without mistakes.", "页面显示的是最近一次没有错误的场景。"],
    stale_derivation: ["The scene has a mistake; mend it and the derivation is checked again.", "场景有错误；改正后会重新检查推导。"],
    offline: ["Works offline", "可离线使用"],
    private: ["Nothing you write leaves this machine.", "您写的内容不会离开这台设备。"],
    derivation_hint: [
        "Write your derivation here, in LaTeX, Markdown or plain text. Each line is checked while you type, for example\n\nT = m*l^2*theta'^2/2\nV = -m*g*l*cos(theta)",
        "在此写下推导，可用 LaTeX、Markdown 或纯文本。输入时逐行检查，例如\n\nT = m*l^2*theta'^2/2\nV = -m*g*l*cos(theta)"],
    scene_hint: ["Write a scene here, or choose an example.", "在此写场景，或选择示例。"],
    empty_scene: ["The scene is empty: choose an example, or write one.", "场景是空的：请选择示例，或自己写一个。"],
    line: ["line {n}", "第 {n} 行"],
    warning: ["Warning", "警告"],
    mistake_word: ["Mistake", "错误"],
    editor_scene: ["Scene, TOML", "场景，TOML"],
    editor_derivation: ["Derivation by hand", "手写推导"],
    messages: ["Messages", "消息"],
    look: ["Result", "结果"],
    choices: ["Completions", "补全"],
    keys: ["Ctrl+Space completes", "Ctrl+空格 补全"],
    shared: ["Shared by link", "由链接分享"],
    own: ["Your own texts", "您自己的文字"],
    not_kept: ["This browser does not keep what you write: save it before you leave the page.", "此浏览器不会保留您写的内容：离开页面前请保存。"],
    divide: ["Width of the two sides", "两侧的宽度"],
    no_wasm: ["This browser has no WebAssembly, which the program needs. A current Firefox, Chrome, Edge or Safari has it.",
        "此浏览器没有 WebAssembly，程序无法运行。新版 Firefox、Chrome、Edge 或 Safari 都有。"],
    no_exceptions: ["This browser's WebAssembly has no exceptions, which the program needs. Chrome 95, Firefox 100 and Safari 15.2 have them, and every later one.",
        "此浏览器的 WebAssembly 不支持异常，程序无法运行。Chrome 95、Firefox 100、Safari 15.2 及以后的版本都支持。"],
    no_program: ["The program could not be loaded: {why}. The files alembert.wasm and alembert.mjs must stand in the folder of this page.",
        "无法载入程序：{why}。文件 alembert.wasm 和 alembert.mjs 须与此页面在同一文件夹中。"],
    died: ["The program ended unexpectedly: {why}. Change the text to try again.", "程序意外结束：{why}。修改文字可重试。"],
    bad_link: ["The link could not be read: {why}. An example is shown in its place.", "无法读取链接：{why}。已显示一个示例。"],
    no_compression: ["This browser cannot pack a link (it has no CompressionStream).", "此浏览器无法压缩链接（没有 CompressionStream）。"],
    // Verdicts on claims, and what is said of the lines of a derivation
    proved: ["proved", "已证明"],
    refuted: ["refuted", "已否定"],
    undecided: ["undecided", "不能判定"],
    vacuous: ["vacuous", "恒可满足，无意义"],
    right: ["right", "正确"],
    right_near: ["right to first order", "一阶近似正确"],
    right_up_to_constant: ["right up to a constant", "除一个常数外正确"],
    right_up_to_derivative: ["right up to d/dt", "差一个全导数"],
    definition: ["definition", "定义"],
    mistake: ["mistake", "错误"],
    follows_from: ["follows from line {n}", "由第 {n} 行得出"],
    follows: ["follows from a mistake", "由错误得出"],
    unfounded: ["true, but does not follow", "正确，但不能由上文得出"],
    not_understood: ["not understood", "没有读懂"],
    not_about_scene: ["not about the scene", "与场景无关"],
};

const spoken = { language: "en" };

export function speak(language) {
    spoken.language = language === "zh" ? "zh" : "en";
    document.documentElement.lang = spoken.language;
}

export const language = () => spoken.language;

/// The text of that name, with what stands for {name} in it.
export function say(name, values = {}) {
    const [english, chinese] = strings[name];
    const text = spoken.language === "zh" ? chinese : english;
    return text.replace(/\{(\w+)\}/g, (_, key) => values[key]);
}
