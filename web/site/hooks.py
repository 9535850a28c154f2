# SPDX-License-Identifier: MIT
"""What MkDocs does not do by itself: the navigation from README.md's table "Read on", each page in the words of its
language, and a few forms of Markdown that only GitHub takes."""

import itertools
import pathlib
import re
from urllib.parse import urlsplit

from markdown.extensions import toc

FENCE = re.compile(r"^```.*?^```", re.M | re.S)
LINK = re.compile(r"\[([^][]+)\]\(([^)#\s]+)\)")


def unique(name, taken, *_):
    """The second heading of a name gets -1, as GitHub has it, where Python-Markdown would write _1."""
    found = next(one for one in itertools.chain([name], (f"{name}-{k}" for k in itertools.count(1))) if one and one not in taken)
    taken.add(found)
    return found


toc.unique = unique


def of_chinese(source):
    return source.endswith(".zh.md")


def read_on(pages, readme, title):
    """[{title: page}] in the order of the table below the heading `title`."""
    table = (pages / readme).read_text(encoding="utf-8").split(f"\n## {title}\n")[1].split("\n## ")[0]
    chinese = of_chinese(readme)
    found = [{text: target} for text, target in LINK.findall(table)
             if target.endswith(".md") and of_chinese(target) == chinese]
    assert len(found) > 3, f"{readme} has no table below {title!r}"
    return found


def on_config(config):
    pages = pathlib.Path(config.docs_dir)
    english = [{"Start": "README.md"}, *read_on(pages, "README.md", "Read on"), {"Gallery": "gallery/index.md"}]
    chinese = [{"开始": "README.zh.md"}, *read_on(pages, "README.zh.md", "继续阅读"), {"图库": "gallery/index.zh.md"}]
    if (pages / "playground/index.html").exists():
        english.append({"Playground": "playground/index.html"})
    config.nav = [{"English": english}, {"中文": chinese}]
    return config


def is_folder(page, target):
    if urlsplit(target).scheme:
        return False
    return (pathlib.Path(page.file.abs_src_path).parent / target).is_dir()


def on_page_markdown(markdown, page, **_):
    def prose(text):  # a link to a folder is one to the list of its files
        return LINK.sub(lambda m: f"[{m[1]}]({m[2].rstrip('/')}/index.md)" if is_folder(page, m[2]) else m[0], text)

    def block(text):  # "```toml NAME" is a file of that name
        return re.sub(r"\A```(\w+) ([^\s=]+)$", r'```\1 title="\2"', text, flags=re.M)

    parts, at = [], 0
    for fence in FENCE.finditer(markdown):
        parts += [prose(markdown[at:fence.start()]), block(fence[0])]
        at = fence.end()
    return "".join([*parts, prose(markdown[at:])])


def on_page_context(context, page, config, **_):
    """The theme's own words, and the way to the same page in the other language."""
    source = page.file.src_uri
    chinese = of_chinese(source)
    config.theme["language"] = "zh" if chinese else "en"
    folder = pathlib.Path(config.docs_dir)
    other = source.removesuffix(".zh.md") + ".md" if chinese else source.removesuffix(".md") + ".zh.md"

    def address(uri):
        return re.sub(r"(README\.md|index\.md)$", "index.html", uri).removesuffix(".md").removesuffix(".html") + ".html"

    if not (folder / other).exists():
        other = "README.md" if chinese else "README.zh.md"
    here, there = address(source), address(other)
    config.extra["alternate"] = [
        {"name": "English", "link": there if chinese else here, "lang": "en"},
        {"name": "中文", "link": here if chinese else there, "lang": "zh"}]
    return context


def on_post_page(output, **_):
    """Without what the theme's script would ask a server for: it looks into sitemap.xml for alternates that are told so."""
    return re.sub(r'<link rel="alternate"[^>]*hreflang[^>]*>', "", output)
