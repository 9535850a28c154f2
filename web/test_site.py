#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Reads the documentation site (web/site.sh), as files and in headless Chromium: test_site.py [FOLDER [SHOTS]]

Every link to a file or a place in one is right; every scene has a page with figure, equations and a page that moves, in both
languages; every page of docs/ is there. Then the site is opened from the disk, where no server helps: the start, the other
language, the gallery and a scene; words are searched for in English and in Chinese. Nothing is asked of any server,
nothing is written to the console, and nothing is wider than the window at 1400 and 400 px. Pictures are kept in the folder SHOTS.
Exit code 1 where something is wrong, 77 where there is no browser."""

import html.parser
import pathlib
import shutil
import sys
import time
from urllib.parse import unquote, urlsplit

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "tests/browser"))
sys.dont_write_bytecode = True
from webdriver import Browser  # noqa: E402

WAIT = 60  # seconds, on a machine that does other things too
failures = []


def expect(what, right, found=""):
    print("ok     " if right else "FAILED ", what, "" if right else f"\n    {found}", sep="", flush=True)
    if not right:
        failures.append(what)


class Page(html.parser.HTMLParser):
    """Where a page links to, and the places in it."""

    def __init__(self, file):
        super().__init__()
        self.targets, self.places, self.classes = [], set(), set()
        self.feed(file.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attributes):
        for name, value in attributes:
            if name in ("href", "src") and value:
                self.targets.append((tag, value))
            if name in ("id", "name") and value:
                self.places.add(value)
            if name == "class" and value:
                self.classes.update(value.split())


def is_of_mkdocs(file, site):
    """Not a page of `report`, nor of the playground."""
    return ".live." not in file.name and site / "playground" not in file.parents


def links(site):
    pages = {file: Page(file) for file in site.rglob("*.html") if is_of_mkdocs(file, site)}
    wrong, outside = [], set()
    for file, page in pages.items():
        if file.name == "404.html":  # which a server gives in any folder
            continue
        for tag, target in page.targets:
            parts = urlsplit(target)
            if parts.scheme in ("http", "https") or parts.netloc:
                outside.add((tag, target))
                continue
            to = (file.parent / unquote(parts.path)).resolve() if parts.path else file
            if to.is_dir():
                to = to / "index.html"
            if not to.is_file():
                wrong.append(f"{file.relative_to(site)} -> {target}")
            elif parts.fragment and to in pages and unquote(parts.fragment) not in pages[to].places:
                wrong.append(f"{file.relative_to(site)} -> {target}")
    expect(f"all links of {len(pages)} pages are right", not wrong, "\n    ".join(wrong[:20]))
    loaded = {target for tag, target in outside if tag != "a"}
    expect("no page loads anything from elsewhere", not loaded, loaded)
    return pages


def whole(site, pages):
    scenes = sorted((ROOT / "scenes").rglob("*.toml"))
    lost = []
    for scene in scenes:
        name = f"{scene.parent.relative_to(ROOT / 'scenes').as_posix().replace('/', '-')}-{scene.stem}"
        for language, ending in (("en", ""), ("zh", ".zh")):
            page = pages.get(site / f"gallery/{name}{ending}.html")
            lost += [f"{name}: {what} ({language})" for what, there in (
                ("page", page), ("figure", (site / f"gallery/{name}.{language}.svg").is_file()),
                ("equations", page and "equations" in page.classes), ("motion", (site / f"gallery/{name}.live.{language}.html").is_file()))
                if not there]
    expect(f"{len(scenes)} scenes have page, figure, equations and motion in both languages", not lost, "\n    ".join(lost[:20]))
    absent = [page.name for page in (ROOT / "docs").glob("*.md") if not (site / "docs" / f"{page.stem}.html").is_file()]
    expect("every page of docs/ is there", not absent, absent)


def until(browser, script, seconds=WAIT):
    end = time.monotonic() + seconds
    while not (value := browser.run(script)) and time.monotonic() < end:
        time.sleep(0.1)
    return value


def searched(browser, words):
    """The addresses of what the search finds."""
    browser.run("const box = document.querySelector('.md-search__input'); document.querySelector('#__search').click(); box.focus();"
                "box.value = arguments[0]; box.dispatchEvent(new KeyboardEvent('keyup', { bubbles: true }));"
                "box.dispatchEvent(new Event('input', { bubbles: true }));", words)
    until(browser, "return document.querySelectorAll('.md-search-result__link').length > 0")
    return browser.run("return [...document.querySelectorAll('.md-search-result__link')].map((one) => one.getAttribute('href'))")


def read(site, shots):
    def at(page):
        return (site / page).as_uri()

    visits = {"index.html": "alembert", "README.zh.html": "alembert", "docs/guide.zh.html": "指南", "docs/commands.html": "The commands",
              "gallery/index.html": "Gallery", "gallery/textbook-double_pendulum.html": "Two masses", "docs/elements.html": "Elements"}
    with Browser() as browser:
        for page, heading in visits.items():
            for width in (1400, 400):
                browser.resize(width, 900)
                browser.open(at(page))
                title = browser.run("return document.querySelector('h1').textContent")
                wide = browser.run("return document.documentElement.scrollWidth - innerWidth")
                expect(f"{page} at {width} px", heading in title and wide <= 0, f"{title!r}, {wide} px too wide")
                if shots:
                    browser.picture(str(pathlib.Path(shots) / f"{page.replace('/', '-')}-{width}.png"))
        browser.resize(1400, 900)
        browser.open(at("docs/guide.html"))
        other = browser.run("return document.querySelector('.md-select__link[hreflang=zh]').href")
        expect("a page leads to itself in the other language", other == at("docs/guide.zh.html"), other)
        browser.open(other)
        language = browser.run("return document.documentElement.lang + document.querySelector('.md-search__input').placeholder")
        expect("where the theme speaks Chinese", language == "zh搜索", language)
        browser.open(at("gallery/textbook-double_pendulum.html"))
        size = browser.run("const s = document.querySelector('math').getBoundingClientRect(), f = document.querySelector('img.figure');"
                           "return [s.width, s.height, f.naturalWidth]")
        expect("a scene shows its equations and its figure", min(size) > 20, size)
        for words, wanted in (("nonholonomic", "docs/"), ("Atwood", "gallery/textbook-double_atwood.html"), ("约束", ".zh.html")):
            browser.open(at("docs/guide.html"))
            found = searched(browser, words)
            expect(f"a search for {words} finds {wanted}", any(wanted in one for one in found), found[:5])
        if shots:
            browser.picture(str(pathlib.Path(shots) / "search.png"))
        said = [line for line in browser.console()]
        expect("nothing is written to the console", not said, said[:5])
        asked = [one for one in browser.requests() if not str(one).startswith(("file:", "data:", "blob:", "about:"))]
        expect("nothing is asked of a server", not asked, asked[:5])


def main(folder=ROOT / "build/site", shots=None):
    site = pathlib.Path(folder).resolve()
    if not (site / "index.html").is_file():
        print(f"there is no {site}/index.html: web/site.sh makes it")
        return 5
    whole(site, links(site))
    if not shutil.which("chromium") or not shutil.which("chromedriver"):
        print("there is no browser here")
        return 1 if failures else 77
    read(site, shots)
    print(f"{len(failures)} failures" if failures else "the site is whole and opens from the disk")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
