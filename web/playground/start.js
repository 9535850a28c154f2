// SPDX-License-Identifier: MIT
// Says what is wrong where the modules of the page cannot even be loaded; so it stands alone.
"use strict";
(() => {
    const tell = (english, chinese) => {
        const place = document.getElementById("problem");
        place.textContent = navigator.language.startsWith("zh") ? chinese : english;
        place.hidden = false;
    };
    addEventListener("DOMContentLoaded", () => {
        if (location.protocol === "file:")
            tell("Browsers do not let a page that was opened as a file load a program. Serve this folder, for instance by “python3 -m http.server” in it, and open http://localhost:8000/.",
                "以文件方式打开的页面，浏览器不允许载入程序。请用网络服务器打开此文件夹，例如在其中运行“python3 -m http.server”，然后访问 http://localhost:8000/。");
        else if (!("noModule" in HTMLScriptElement.prototype))
            tell("This browser is too old for this page: it has no modules.", "此浏览器过旧，不支持模块，无法使用此页面。");
    });
    addEventListener("error", (event) => {
        const { tagName, src } = event.target ?? {};
        if (tagName === "SCRIPT" && location.protocol !== "file:")
            tell(`A part of this page is missing: ${src}. The whole folder must be copied.`, `页面缺少一个部分：${src}。须复制整个文件夹。`);
    }, true);
})();
