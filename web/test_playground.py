#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Uses the playground (web/playground.sh) in headless Chromium, as a reader does: test_playground.py [FOLDER [SHOTS]]

It is served from a folder below the root of a server of plain files. A mistake is typed, seen at its line, and corrected;
names are completed; an example is chosen; a derivation with a slip is judged; a link is shared and opened in another
window; texts of one's own stay, whatever is opened and in however many windows; the server is stopped and all goes on. Nothing is asked of any other server, nothing is written to the console,
and nothing is wider than the window at 1400 and 400 px. Pictures are kept in the folder SHOTS. Exit code 1 where
something is wrong, 77 where there is no browser."""

import functools
import http.server
import os
import pathlib
import shutil
import sys
import tempfile
import threading
import time
import urllib.error
import urllib.request

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "tests/browser"))
sys.dont_write_bytecode = True
from webdriver import Browser  # noqa: E402

ENTER, ESCAPE = "\ue007", "\ue00c"
WAIT = 30  # seconds, on a machine that does other things too
failures = []


class Files(http.server.SimpleHTTPRequestHandler):
    """Files of a folder; a server for WebAssembly needs no more than the types of its files."""

    extensions_map = {**http.server.SimpleHTTPRequestHandler.extensions_map, ".mjs": "text/javascript",
                      ".js": "text/javascript", ".wasm": "application/wasm"}

    def log_message(self, *_):
        pass


class Server(http.server.ThreadingHTTPServer):
    daemon_threads = True

    def __init__(self, folder):
        super().__init__(("127.0.0.1", 0), functools.partial(Files, directory=folder))
        threading.Thread(target=self.serve_forever, daemon=True).start()
        self.address = f"http://127.0.0.1:{self.server_port}/"

    def stop(self):
        self.shutdown()
        self.server_close()


def expect(what, right, found=""):
    print("ok     " if right else "FAILED ", what, "" if right else f"\n    {found}", sep="", flush=True)
    if not right:
        failures.append(what)


class Reader:
    """What a person does with the page, and sees of it."""

    def __init__(self, browser, shots):
        self.browser = browser
        self.shots = shots

    def wait(self, script, *arguments):
        """Until the script returns something that is true; its last value."""
        end = time.monotonic() + WAIT
        while True:
            value = self.browser.run(script, *arguments)
            if value or time.monotonic() > end:
                return value
            time.sleep(0.02)

    def settled(self):
        """The state of the page as soon as nothing is being done."""
        self.wait("return !['working', undefined].includes(document.body.dataset.state)")
        return self.browser.run("return document.body.dataset.state")

    def put_caret(self, area, behind, select=0):
        self.browser.run("""const [id, behind, select] = arguments, area = document.getElementById(id);
            const at = area.value.indexOf(behind) + behind.length;
            area.focus(); area.setSelectionRange(at, at + select);""", area, behind, select)

    def type(self, text):
        """Keys, to where the caret is."""
        pressed = [{"type": kind, "value": key} for key in text for kind in ("keyDown", "keyUp")]
        value = "return document.activeElement.value"
        before = self.browser.run(value)
        self.browser._do("POST", "actions", {"actions": [{"type": "key", "id": "keyboard", "actions": pressed}]})
        self.wait("return document.activeElement.value !== arguments[0]", before)

    def keys(self, *keys):
        for key in keys:
            self.browser.press(key)

    def choose(self, example):
        self.browser.run("""const menu = document.getElementById("examples");
            menu.value = arguments[0]; menu.dispatchEvent(new Event("change"));""", example)

    def write(self, text, area="scene"):
        """A whole text in place of what is there, as if it were pasted."""
        self.browser.run("""const [id, text] = arguments, area = document.getElementById(id);
            area.focus(); area.select(); document.execCommand("insertText", false, text);""", area, text)

    def own_texts(self):
        """What the menu says of the reader's own texts, and what is shown when each is chosen."""
        own = self.browser.run("""return [...document.querySelectorAll("#examples option")].filter((one) => one.value.startsWith("own"))
            .map((one) => [one.value, one.textContent]);""")
        found = []
        for value, said in own:
            self.choose(value)
            found.append((said, *self.browser.run("return ['scene', 'derivation'].map((id) => document.getElementById(id).value)")))
        return found

    def window(self, url):
        """Another window; gives that which was there, for `back_to`."""
        first = self.browser._do("GET", "window")
        self.browser._do("POST", "window", {"handle": self.browser._do("POST", "window/new", {"type": "window"})["handle"]})
        self.browser.resize(1400, 900)
        self.browser.open(url)
        return first

    def back_to(self, window, close=True):
        other = self.browser._do("GET", "window")
        if close:
            self.browser._do("DELETE", "window")
        self.browser._do("POST", "window", {"handle": window})
        return other

    def text(self, selector):
        return self.browser.run("return document.querySelector(arguments[0])?.innerText ?? ''", selector)

    def inside(self, frames, script):
        """What a script returns of the page in the frame that is shown."""
        return self.browser.run(f"""const inside = document.querySelector("#{frames} iframe:not(.coming)")?.contentDocument;
            return inside ? (() => {{ {script} }})() : null;""")

    def shown(self, frames, word):
        """Until the page in the frame has this word."""
        end = time.monotonic() + WAIT
        while time.monotonic() < end:
            text = self.inside(frames, "return inside.body?.textContent ?? ''") or ""
            if word in text:
                return True
            time.sleep(0.05)
        return False

    def picture(self, name):
        if self.shots:
            self.browser.picture(os.path.join(self.shots, f"{name}.png"))

    def fits(self, what):
        wide = self.browser.run("""const wide = document.documentElement.clientWidth;
            return [...document.querySelectorAll("header *, .tabs *, footer *, #messages, .editor, .frames")]
                .filter((e) => e.offsetParent && e.getBoundingClientRect().right > wide + 1).map((e) => e.outerHTML.slice(0, 80)).join("; ")
                || (document.documentElement.scrollWidth > wide ? "the page" : "");""")
        expect(f"nothing is wider than the window: {what}", not wide, wide)
        odd = self.browser.run("""const area = document.querySelector("[role=tabpanel]:not([hidden]) textarea");
            const under = area?.previousElementSibling;
            return area?.offsetParent && area.scrollHeight - under.scrollHeight > 1 ? `${area.scrollHeight} ${under.scrollHeight}` : "";""")
        expect(f"text and colours lie on each other: {what}", not odd, odd)


def first_answer(reader):
    """Milliseconds from the beginning of the visit to the program, to the first verdicts and to the first page."""
    reader.wait("return document.documentElement.dataset.firstPage && document.documentElement.dataset.firstAnswer")
    return reader.browser.run("const {loaded, firstAnswer, firstPage} = document.documentElement.dataset; return [loaded, firstAnswer, firstPage].map(Number);")


def first_answers(reader, url):
    """The same of a few more visits."""
    found = []
    for _ in range(3):
        reader.browser.open("about:blank")
        reader.browser.open(url)
        found.append(first_answer(reader))
    return found


def test_scene(reader):
    reader.choose("textbook/double_pendulum")
    expect("an example is shown with its equations", reader.settled() == "ready" and reader.shown("page", "Equations of motion"))
    expect("its equations are mathematics", (reader.inside("page", "return inside.querySelectorAll('#equations math').length") or 0) > 0)
    expect("its figure is drawn", (reader.inside("page", "return inside.querySelectorAll('.stage svg.figure path').length") or 0) > 3)
    expect("its claims are proved", reader.text("#messages").count("proved") == 2, reader.text("#messages"))
    expect("a proved claim is marked at its line", reader.browser.run("return document.querySelectorAll('#panel-scene .line.has-good').length") == 2)
    reader.picture("scene-1400")

    reader.put_caret("scene", 'position = ["l1*')
    reader.type("foo*")
    state = reader.settled()
    expect("a mistake is told", state == "faulty" and "unknown name 'foo'" in reader.text("#messages"), f"{state}: {reader.text('#messages')}")
    expect("at its line", reader.browser.run("return document.querySelector('#panel-scene .line.has-bad')?.dataset.n") == "22")
    expect("at its word", reader.text("#panel-scene .mark.bad") == "foo", reader.text("#panel-scene .mark.bad"))
    expect("the last page is still there, and said to be old", not reader.browser.run("return document.getElementById('note').hidden")
           and reader.shown("page", "Equations of motion"))
    reader.picture("mistake-1400")
    reader.put_caret("scene", "l1*", len("foo*"))
    reader.type("2*")
    state = reader.settled()
    expect("the mistake is corrected", state == "ready" and not reader.browser.run("return document.querySelector('#panel-scene .has-bad')"), state)
    expect("claims that are no longer right are refuted", "refuted" in reader.text("#messages"), reader.text("#messages"))
    expect("the changed text is the reader's own", reader.browser.run("return document.getElementById('examples').value.startsWith('own')"))


def test_completion(reader):
    reader.put_caret("scene", "[simulation]")
    reader.keys(ENTER)
    reader.type("ste")
    offered = reader.wait("return [...document.querySelectorAll('.choices:not([hidden]) b')].map((e) => e.textContent).join(' ')")
    expect("keys of the table are offered", "step" in (offered or "").split(), offered)
    reader.picture("completion-1400")
    reader.keys(ENTER)
    expect("Enter takes one", "[simulation]\nstep = " in reader.browser.run("return document.getElementById('scene').value"))
    reader.put_caret("scene", "step = ")
    reader.type('"the')
    offered = reader.wait("return [...document.querySelectorAll('.choices:not([hidden]) b')].map((e) => e.textContent).join(' ')")
    expect("names of the scene are offered in an expression", "theta1" in (offered or "").split(), offered)
    reader.keys(ESCAPE)
    expect("Escape closes the list", not reader.browser.run("return document.querySelector('.choices:not([hidden])')"))


def test_derivation(reader):
    reader.choose("textbook/double_pendulum")
    reader.browser.click("#tab-derivation")
    expect("the slip of a derivation is found", reader.settled() == "ready" and reader.shown("marked", "First mistake: line 5"))
    expect("its line is marked as wrong", reader.browser.run("return document.querySelector('#panel-derivation .line.has-refuted')?.dataset.n") == "5")
    expect("right lines are marked as right", reader.browser.run("return [...document.querySelectorAll('#panel-derivation .line.has-good')].map((e) => e.dataset.n).join()") == "4,9")
    expect("the correction is told", "-V = (m1 + m2)*g*l1*cos(theta1)" in reader.text("#messages"), reader.text("#messages"))
    reader.picture("derivation-1400")
    reader.put_caret("derivation", "V &= ")
    reader.type("-")
    reader.put_caret("derivation", "\\cos\\theta_1 ", 1)
    reader.type("-")
    reader.settled()
    expect("the corrected line is right", reader.wait("return document.querySelector('#panel-derivation .line[data-n=\"5\"]').classList.contains('has-good')"),
           reader.text("#messages"))


def test_link(reader):
    reader.browser.click("#share")
    link = reader.wait("return location.hash.startsWith('#1.') && location.href")
    expect("a link holds the texts", bool(link))
    texts = "JSON.stringify([document.getElementById('scene').value, document.getElementById('derivation').value])"
    before = reader.browser.run("return " + texts)
    browser = reader.browser
    first = reader.window(link)
    same = reader.wait(f"return document.body.dataset.state === 'ready' && {texts} === arguments[0]", before)
    expect("another window shows them", same, browser.run("return " + texts))
    expect("and the tab that was shared, with its verdicts", reader.shown("marked", "right") and browser.run("return document.body.dataset.tab") == "derivation")
    browser.open(link[:-9] + "AAAAAAAAA")
    reader.wait("return !document.getElementById('problem').hidden")
    expect("a broken link is said to be one", "could not be read" in reader.text("#problem"), reader.text("#problem"))
    reader.back_to(first)
    return link


def test_own_texts(reader, url, link):
    """Whatever is typed stays, until twenty other texts have been: examples, links and other windows take nothing away."""
    browser = reader.browser
    texts = "return document.getElementById('scene').value"
    menu = "return document.getElementById('examples').value"

    def visit(keep=()):
        browser.open("about:blank")
        browser.open(url + "icon.svg")
        browser.run("localStorage.clear(); sessionStorage.clear(); for (const [key, value] of arguments[0]) localStorage.setItem(key, value);", list(keep))
        browser.open(url)
        reader.settled()
        if not keep:
            reader.choose("textbook/foucault_pendulum")  # which has no derivation

    def is_kept(*scenes):
        kept = [scene for _, scene, _ in reader.own_texts()]
        return all(any(scene in one for one in kept) for scene in scenes), kept

    visit()
    first = 'title = "A pendulum of my own"\n[parameters]\nm = 1\nl = 2\ng = 9.81\n'
    reader.write(first)
    reader.put_caret("scene", "9.81\n")
    reader.type("k = 3")
    reader.settled()
    reader.choose("textbook/watt_governor")
    reader.put_caret("scene", "[coordinates]\n")
    reader.type("1")
    own = reader.own_texts()
    expect("a text of one's own is kept where an example is changed", any(scene == first + "k = 3" for _, scene, _ in own), own)
    expect("the menu says its title and its date", any("A pendulum of my own" in said and time.strftime("%Y") in said for said, *_ in own), own)
    browser.click("#tab-derivation")
    reader.write("T = m*l^2*theta'^2/2", "derivation")
    browser.open(link)
    reader.settled()
    reader.wait(texts)
    browser.click("#tab-scene")
    reader.put_caret("scene", "[coordinates]\n")
    reader.type("2")
    right, kept = is_kept(first + "k = 3", "[coordinates]\n1", "[coordinates]\n2")
    expect("so it is where a link is opened and changed", right and any("T = m*l^2" in derivation for *_, derivation in reader.own_texts()), kept)

    visit()
    reader.write(first)
    shown = browser.run(menu)
    browser.open(url)
    reader.wait("return document.getElementById('scene').value === arguments[0]", first)
    expect("a window that is loaded again shows its text", browser.run(menu) == shown, browser.run(menu))
    time.sleep(0.2)
    reader.put_caret("scene", "9.81\n")
    reader.type("a = 1")
    expect("and goes on in it", [scene for _, scene, _ in reader.own_texts()] == [first + "a = 1"], reader.own_texts())
    before = reader.window(url)
    expect("a second window shows it too", reader.wait("return document.getElementById('scene').value === arguments[0]", first + "a = 1"))
    time.sleep(0.2)
    reader.put_caret("scene", "a = 1")
    reader.type("2")
    second = reader.back_to(before, close=False)
    reader.put_caret("scene", "a = 1")
    reader.type("3")
    browser._do("POST", "window", {"handle": second})
    reader.put_caret("scene", "a = 12")
    reader.type("4")
    right, kept = is_kept(first + "a = 124", first + "a = 13")
    expect("what two windows write stays, of both", right and len(kept) == 2, kept)
    reader.back_to(before)
    right, kept = is_kept(first + "a = 124", first + "a = 13")
    expect("and both are in the menu of the other", right, kept)

    visit()
    long = first + "# a line that nobody wants to type again\n" * 3
    reader.write(long)
    reader.write("q")
    right, kept = is_kept(long)
    expect("a text that is replaced as a whole stays", right and len(kept) == 2, kept)
    reader.choose(browser.run("return [...document.querySelectorAll('#examples option')].find((one) => one.textContent.includes('pendulum of my own')).value"))
    time.sleep(0.2)
    browser.run("""const area = document.getElementById("scene"); area.focus();
        while (area.value) { area.setSelectionRange(area.value.length, area.value.length); document.execCommand("delete"); }""")
    right, kept = is_kept(long)
    expect("so does one that is deleted letter by letter", right and len(kept) == 2, kept)

    visit()
    for k in range(22):
        reader.choose("textbook/watt_governor")
        reader.write(f'title = "Number {k}"\n')
        time.sleep(0.002)
    kept = [scene for _, scene, _ in reader.own_texts()]
    expect("the last twenty are kept, the newest first", kept == [f'title = "Number {k}"\n' for k in range(21, 1, -1)], kept)

    visit([["alembert.own", '{"scene": "title = \\"Former\\"", "derivation": "T = 1"}']])
    own = reader.own_texts()
    expect("the one text that earlier versions kept is among them", len(own) == 1 and own[0][1:] == ('title = "Former"', "T = 1"), own)

    visit([["other", "x" * 5_242_000]])
    reader.write(long * 4)
    expect("where nothing can be kept, the page says so", "does not keep" in reader.text("#problem"), reader.text("#problem"))
    visit()


def test_narrow(reader, url):
    reader.browser.resize(400, 860, dark=True)
    reader.browser.open(url)
    reader.choose("textbook/watt_governor")
    reader.settled()
    reader.fits("400 px, the scene")
    reader.picture("scene-400")
    reader.browser.click("#tab-result")
    expect("on a phone the page has a tab of its own", reader.shown("page", "Equations of motion"))
    reader.fits("400 px, the page")
    wide = reader.inside("page", "return inside.documentElement.scrollWidth - inside.documentElement.clientWidth")
    expect("the page fits a phone", wide == 0, wide)
    reader.picture("page-400")
    reader.browser.click("#tab-derivation")
    reader.settled()
    reader.fits("400 px, the derivation")
    reader.picture("derivation-400")


def test_chinese(reader):
    reader.browser.click("#language")
    reader.browser.click("#tab-scene")
    expect("the page of the program is Chinese", reader.shown("page", "运动方程"))
    expect("so are the words around it", reader.text("#share") == "分享链接" and "已证明" in reader.text("#messages"), reader.text("#messages"))
    reader.put_caret("scene", "[coordinates]\n")
    reader.type("1 ")
    expect("and mistakes", reader.settled() == "faulty" and any("\u4e00" <= c <= "\u9fff" for c in reader.text("#messages .what")), reader.text("#messages"))
    reader.picture("mistake-chinese-400")
    reader.browser.click("#language")
    reader.settled()


def test_offline(reader, server, url):
    reader.browser.resize(1400, 900)
    reader.browser.open(url)
    reader.settled()
    expect("the page says that it works offline", reader.wait("return !document.getElementById('offline').hidden"))
    server.stop()
    try:
        urllib.request.urlopen(url, timeout=2)
        expect("the server is stopped", False)
    except (urllib.error.URLError, OSError):
        pass
    reader.browser.open("about:blank")
    reader.browser.open(url)
    reader.settled()
    reader.choose("textbook/coupled_oscillators")
    expect("without a server an example is shown", reader.settled() == "ready" and reader.shown("page", "Two masses between two walls"))
    reader.browser.click("#tab-derivation")
    expect("and a derivation is judged", reader.settled() == "ready" and reader.shown("marked", "Right:"))
    reader.picture("offline-1400")


def test_failures(reader, folder):
    """What a reader is told where the page cannot work: parts are missing, exceptions are not there, no server."""
    (folder / "broken").mkdir()
    for file in (folder / "play").iterdir():
        if file.name != "alembert.wasm":
            shutil.copy(file, folder / "broken")
    server = Server(folder)
    reader.browser.open(server.address + "broken/")
    reader.wait("return !document.getElementById('problem').hidden")
    expect("a missing program is told in a sentence", "could not be loaded: alembert.wasm: 404" in reader.text("#problem"), reader.text("#problem"))
    reader.browser.protocol("Page.addScriptToEvaluateOnNewDocument", source="WebAssembly.validate = () => false;")
    reader.browser.open(server.address + "broken/")
    reader.wait("return !document.getElementById('problem').hidden")
    expect("so are missing exceptions", "has no exceptions" in reader.text("#problem"), reader.text("#problem"))
    server.stop()
    reader.browser.open((folder / "broken/index.html").as_uri())
    expect("so is a page that was opened as a file", "http.server" in reader.wait("return document.getElementById('problem').innerText"), reader.text("#problem"))
    reader.browser.console()


def main(folder=ROOT / "build/web/playground", shots=""):
    for tool in ("chromium", "chromedriver"):
        if not shutil.which(tool):
            print(f"there is no {tool} here")
            return int(os.environ.get("ALEMBERT_NO_SKIP", 77))
    if shots:
        os.makedirs(shots, exist_ok=True)
    with tempfile.TemporaryDirectory() as root, Browser() as browser:
        place = pathlib.Path(root) / "some/where"
        shutil.copytree(folder, place / "play")
        server = Server(root)
        url = server.address + "some/where/play/"
        reader = Reader(browser, shots)
        browser.resize(1400, 900)
        browser.open(url)
        reader.settled()
        expect("the first visit shows a page", reader.wait("return document.documentElement.dataset.firstPage") is not None, reader.text("#problem"))
        visits = [first_answer(reader), *first_answers(reader, url)]
        print("       milliseconds to the program, the first verdicts, the first page:", "; ".join(" ".join(map(str, one)) for one in visits))
        test_scene(reader)
        test_completion(reader)
        test_derivation(reader)
        link = test_link(reader)
        test_own_texts(reader, url, link)
        reader.fits("1400 px")
        test_narrow(reader, url)
        test_chinese(reader)
        test_offline(reader, server, url)
        others = [one for one in browser.requests() if not one.startswith((server.address, "data:", "blob:", "about:", "chrome:"))]
        expect("nothing is asked of any other server", not others, others)
        said = [one for one in browser.console() if "favicon" not in one and "net::ERR_CONNECTION_REFUSED" not in one]
        expect("the console is empty", not said, said)
        test_failures(reader, place)
    print("all is right" if not failures else f"{len(failures)} wrong")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
