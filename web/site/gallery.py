# SPDX-License-Identifier: MIT
"""The gallery: of every scene a page with figure, equations, motion and text, and one page that shows all.

    gallery.py PROGRAM SCENES PAGES KEPT

PAGES gets gallery/ with Markdown in both languages, figures, and the pages that move. KEPT holds what the program has made; it is
made again where the program or the files beside the scene have changed. Exit code 1 where the program refuses a scene."""

import concurrent.futures
import hashlib
import html
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tomllib

WORDS = {
    "en": {"gallery": "Gallery", "all": "All {} scenes of the repository. Each has a page with its figure, its equations of motion, "
                                        "the figure in motion, and its text.",
           "figure": "Figure", "equations": "Equations of motion", "motion": "Motion", "moves": "The page on which the figure moves",
           "text": "Scene", "source": "Source", "language": "How scenes are written", "page": "../docs/scene-language.md"},
    "zh": {"gallery": "图库", "all": "本仓库的全部 {} 个场景。每个场景有一页：图、运动方程、运动的图以及场景文本。",
           "figure": "图", "equations": "运动方程", "motion": "运动", "moves": "图形运动的网页",
           "text": "场景", "source": "来源", "language": "场景语言", "page": "../docs/scene-language.zh.md"}}
FOLDERS = {"textbook": ("Textbooks", "教科书"), "gallery": ("Machines", "机器"), "elements": ("Elements", "元件"),
           "modes": ("Modes", "模式"), "friction": ("Dry friction", "干摩擦"), "functions": ("Functions left open", "未给定的函数"),
           "stability": ("Stability", "稳定性"), "benchmark": ("Hard cases for integrators", "积分器的难题"),
           "benchmark/trees": ("Trees of bodies", "树形多体系统"), "benchmark/large": ("Large ones", "大系统")}
ENDING = {"en": ".md", "zh": ".zh.md"}


def escaped(text):
    return re.sub(r"([\\`*_{}\[\]#|])", r"\\\1", html.escape(text, quote=False))


class Scene:
    def __init__(self, file, root):
        self.file = file
        self.folder = file.parent.relative_to(root).as_posix()
        self.name = f"{self.folder.replace('/', '-')}-{file.stem}"
        self.text = file.read_text(encoding="utf-8")
        said = tomllib.loads(self.text)
        self.title = said.get("title", file.stem)
        self.notes, self.source = said.get("notes", ""), said.get("source", "")

    def key(self, program):
        data = hashlib.sha256(program)
        for file in [self.file, *sorted(self.file.parent.glob("*.csv"))]:
            data.update(file.read_bytes())
        return data.hexdigest()


def made(program, scene, folder, key):
    """What the program makes of a scene, in this folder; returns what it could not make."""
    if (folder / "key").exists() and (folder / "key").read_text() == key:
        return []
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    failed = []
    for language in WORDS:
        calls = [(["derive", scene.file, "--format", "mathml", "--language", language, "--svg", folder / f"figure.{language}.svg"],
                  folder / f"equations.{language}"),
                 (["report", scene.file, "--language", language, "-o", folder / f"live.{language}.html"], None)]
        for words, output in calls:
            done = subprocess.run([program, *words], stdout=subprocess.PIPE, stderr=subprocess.PIPE, check=False)
            if done.returncode:
                failed.append(f"alembert {words[0]} {scene.file}: exit code {done.returncode}\n{done.stderr.decode()[-500:]}")
            elif output:
                output.write_bytes(done.stdout)
    if not failed:
        (folder / "key").write_text(key)
    return failed


def equations_of(file):
    """The equations as HTML: sentences, which the program writes as rows over all columns, as paragraphs between tables."""
    row = r'<mtr><mtd columnspan="\d+">\s*<mtext>(.*?)</mtext>\s*</mtd></mtr>'
    text = re.sub(r"\n\s*", "", file.read_text(encoding="utf-8"))
    head, rows, tail = re.fullmatch(r"(<math.*?<mtable[^>]*>)(.*)(</mtable></math>)", text).groups()
    parts = re.split(row, rows)  # rows of equations and sentences by turns
    return "".join(f"<p>{part}</p>" if k % 2 else f"{head}{part}{tail}" for k, part in enumerate(parts) if part)


def page(scene, kept, gallery, language):
    """The page of a scene, and the files that it shows."""
    word = WORDS[language]
    lines = ["---", "search: {boost: 0.5}", "---", "", f"# {escaped(scene.title)}", ""]  # behind the pages that explain
    lines += [f"[{word['gallery']}](index{ENDING[language]})", ""]
    if scene.notes:
        lines += [escaped(scene.notes), ""]
    if scene.source:
        lines += [f"{word['source']}: {escaped(scene.source)}", ""]
    figure, live = f"{scene.name}.{language}.svg", f"{scene.name}.live.{language}.html"
    if (kept / f"figure.{language}.svg").exists():
        shutil.copy(kept / f"figure.{language}.svg", gallery / figure)
        lines += [f'<img class="figure" src="{figure}" alt="{word["figure"]}: {html.escape(scene.title)}">', ""]
    if (kept / f"equations.{language}").exists():
        lines += [f"## {word['equations']} {{ data-search-exclude }}", "", '<div class="equations" data-search-exclude>',
                  equations_of(kept / f"equations.{language}"), "</div>", ""]
    if (kept / f"live.{language}.html").exists():
        shutil.copy(kept / f"live.{language}.html", gallery / live)
        lines += [f"## {word['motion']} {{ data-search-exclude }}", "", f"[{word['moves']}]({live})", ""]
    fence = "`" * (1 + max(map(len, re.findall("`+", scene.text + "``"))))
    lines += [f"## {word['text']} {{ data-search-exclude }}", "", f"[{word['language']}]({word['page']})", "",
              f'{fence}toml title="scenes/{scene.folder}/{scene.file.name}"', scene.text.rstrip(), fence, ""]
    (gallery / f"{scene.name}{ENDING[language]}").write_text("\n".join(lines), encoding="utf-8")


def overview(scenes, gallery, language):
    word = WORDS[language]
    lines = [f"# {word['gallery']}", "", word["all"].format(len(scenes)), ""]
    for folder in [*FOLDERS, *sorted({scene.folder for scene in scenes} - set(FOLDERS))]:
        here = [scene for scene in scenes if scene.folder == folder]
        if not here:
            continue
        title = FOLDERS.get(folder, (folder, folder))[list(WORDS).index(language)]
        lines += [f"## {title}", "", '<div class="scenes">']
        for scene in here:
            ending = ENDING[language].replace(".md", ".html")
            lines.append(f'<a href="{scene.name}{ending}"><img src="{scene.name}.{language}.svg" loading="lazy" alt="">'
                         f'{html.escape(scene.title)}</a>')
        lines += ["</div>", ""]
    (gallery / f"index{ENDING[language]}").write_text("\n".join(lines), encoding="utf-8")


def lists(pages):
    """A page for each folder of examples, to which others link: its files."""
    for folder in [pages / "examples", *(one for one in (pages / "examples").rglob("*") if one.is_dir())]:
        lines = [f"# {folder.relative_to(pages)}", ""]
        for file in sorted(folder.iterdir()):
            lines.append(f"- [{file.name}]({file.name + '/index.md' if file.is_dir() else file.name})")
        (folder / "index.md").write_text("\n".join(lines) + "\n", encoding="utf-8")


def main(program, root, pages, kept):
    program, root, pages, kept = os.path.realpath(program), pathlib.Path(root), pathlib.Path(pages), pathlib.Path(kept)
    gallery = pages / "gallery"
    gallery.mkdir()
    scenes = [Scene(file, root) for file in sorted(root.rglob("*.toml"))]
    bytes_of_program = hashlib.sha256(pathlib.Path(program).read_bytes()).digest()
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        failed = list(pool.map(lambda scene: made(program, scene, kept / scene.name, scene.key(bytes_of_program)), scenes))
    for language in WORDS:
        for scene in scenes:
            page(scene, kept / scene.name, gallery, language)
        overview(scenes, gallery, language)
    lists(pages)
    lost = sum(failed, [])
    print(*lost, sep="\n", end="")
    print(f"{len(scenes)} scenes, {len(lost)} refusals")
    return 1 if lost else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
