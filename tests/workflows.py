#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The workflows of .github/workflows are right as far as that is seen without a server: workflows.py

Each step runs one script of the repository, which is there and executable, and names its options; each action is
pinned to a commit, with its version as a comment; each file of another workflow is there; permissions are named; every row
of the table "Other ways to have it" of README.md is made, in words that tests/ways.sh takes for that row alone. Where
actionlint is installed it reads them too. Dockerfile copies what is there and runs scripts that are there; .devcontainer
names one of its stages. Before that, a folder with faults of all these kinds must be found wrong. Then
packaging/release.sh makes a release of a few small files, and refuses what is no release. Needs Debian's python3-yaml;
skipped with exit code 77 where it is missing, which is a failure where test.sh has installed it."""

import hashlib
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tarfile
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
EXPRESSION = r"\$\{\{[^}]*\}\}"
PINNED = re.compile(r"uses: [\w-]+/[\w/-]+@[0-9a-f]{40} # v\d+\.\d+\.\d+$")


def rows(readme):
    """What each way is for: the first column of README's table."""
    table = re.search(r"^## Other ways to have it$(.*?)^## ", readme, re.M | re.S).group(1)
    return [line.split(" | ")[0][2:] for line in table.splitlines() if line.startswith("| ")][2:]


def of_step(root, step):
    """The faults of a step."""
    if "run" in step:
        line = step["run"].strip()
        if re.search(r"[\n;&|<>`(]", re.sub(EXPRESSION, "", line)):
            yield f"more than one script: {line!r}"
        script = root / line.split()[0]
        if not script.is_file() or not os.access(script, os.X_OK):
            yield f"no executable script: {line!r}"
    elif "uses" not in step:
        yield f"a step that does nothing: {step}"


def of_job(root, name, job):
    """The faults of a job."""
    if "uses" in job:
        if not (root / job["uses"]).is_file():
            yield f"{name}: no such workflow: {job['uses']}"
        return
    if "timeout-minutes" not in job:
        yield f"{name}: no timeout-minutes"
    if job.get("runs-on", "").endswith("latest"):
        yield f"{name}: runs-on changes by itself"
    for step in job["steps"]:
        for fault in of_step(root, step):
            yield f"{name}: {fault}"


def of_ways(root, workflow, readme):
    """The faults of the words by which rows of the table are chosen."""
    words = [word for job in workflow["jobs"].values()
             for way in job.get("strategy", {}).get("matrix", {}).get("include", []) for word in way["way"].split()]
    if not words:
        return
    made = []
    for word in words:
        found = [row for row in rows(readme) if word in row.lower()]
        if len(found) != 1:
            yield f"the word {word!r} is in {len(found)} rows of README.md's table"
        made += found
    for row in rows(readme):
        if made.count(row) != 1:
            yield f"made {made.count(row)} times: {row[:60]}"


def faults(root, readme):
    """All that is wrong below root/.github/workflows, as lines."""
    import yaml
    files = sorted((root / ".github/workflows").glob("*.yml"))
    if not files:
        yield "no workflows"
    for file in files:
        text = file.read_text(encoding="utf-8")
        try:
            workflow = yaml.safe_load(text)
        except yaml.YAMLError as error:
            yield f"{file.name}: not YAML: {error}"
            continue
        found = [f"not pinned: {line.strip()}" for line in text.splitlines()
                 if re.match(r"\s*-?\s*uses: (?!\./)", line) and not PINNED.search(line)]
        if "permissions" not in workflow:
            found.append("no permissions")
        for name, job in workflow["jobs"].items():
            found += of_job(root, name, job)
        found += of_ways(root, workflow, readme)
        yield from (f"{file.name}: {fault}" for fault in found)


def containers(root):
    """The faults of Dockerfile and .devcontainer/devcontainer.json."""
    text = re.sub(r"\\\n\s*", "", (root / "Dockerfile").read_text(encoding="utf-8"))
    stages = re.findall(r"^FROM \S+ AS (\w+)$", text, re.M)
    for source in re.findall(r"^COPY (?!--)(\S+) ", text, re.M):
        if not (root / source).exists():
            yield f"Dockerfile copies {source}, which does not exist"
    for stage in re.findall(r"from=(\w+)", text):
        if stage not in stages:
            yield f"Dockerfile has no stage {stage}"
    image = json.loads((root / ".devcontainer/devcontainer.json").read_text(encoding="utf-8"))
    if image["build"]["target"] not in stages or not (root / ".devcontainer" / image["build"]["dockerfile"]).exists():
        yield f"devcontainer.json builds what does not exist: {image['build']}"
    for line in [*re.findall(r"(?<=[ ;&])\./\S+(?: \S+)?", text), image["onCreateCommand"]]:
        for word in line.split():
            if not (root / word).exists():
                yield f"a container runs {line!r}, and there is no {word}"


FAULTY = """
on: push
jobs:
  one:
    runs-on: ubuntu-latest
    strategy:
      matrix:
        include: [{way: nothing wheel}]
    steps:
      - uses: actions/checkout@v4
      - run: ./there.sh && rm -r build
      - run: ./missing.sh
      - run: ./plain.sh
  two:
    uses: ./.github/workflows/none.yml
"""
FOUND = ["not pinned: - uses: actions/checkout@v4", "no permissions", "more than one script: './there.sh && rm -r build'",
         "no executable script: './missing.sh'", "no executable script: './plain.sh'", "one: no timeout-minutes",
         "runs-on changes by itself", "no such workflow: ./.github/workflows/none.yml", "the word 'nothing' is in 0 rows",
         "made 0 times: npm", "not YAML", "Dockerfile copies gone.sh", "no stage made", "builds what does not exist",
         "there is no ./missing.sh", "there is no ./absent.sh"]


def faults_are_found(readme):
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder)
        (root / ".github/workflows").mkdir(parents=True)
        (root / ".github/workflows/faulty.yml").write_text(FAULTY)
        (root / ".github/workflows/broken.yml").write_text("on: [push\njobs: {")
        (root / "plain.sh").write_text("")
        (root / "there.sh").write_text("")
        (root / "there.sh").chmod(0o755)
        said = "\n".join(faults(root, readme))
        (root / ".devcontainer").mkdir()
        (root / "Dockerfile").write_text("FROM debian:12 AS tools\nCOPY gone.sh .\nRUN ./missing.sh scene && \\\n    ./there.sh\n"
                                         "COPY --from=made /a /b\n")
        (root / ".devcontainer/devcontainer.json").write_text(
            '{"build": {"dockerfile": "../Dockerfile", "target": "none"}, "onCreateCommand": "./absent.sh"}')
        said += "\n".join(containers(root))
    return [f"not found where it is wrong: {fault}" for fault in FOUND if fault not in said]


def release(root, *words, **environment):
    return subprocess.run([root / "packaging/release.sh", *words], capture_output=True, text=True, check=False,
                          env={**os.environ, **environment})


def releases():
    """packaging/release.sh on a few files, with a `gh` that keeps its words."""
    version = subprocess.run([ROOT / "packaging/version.sh"], capture_output=True, text=True, check=True).stdout.strip()
    with tempfile.TemporaryDirectory() as folder:
        work = pathlib.Path(folder)
        shutil.copytree(ROOT / "packaging", work / "packaging")
        shutil.copy(ROOT / "CMakeLists.txt", work)
        (work / "CHANGELOG.md").write_text(f"# Changes\n\n## {version}\n\nWhat is new.\n\n## 0.0.1\n\nOld.\n")
        (work / "gh").write_text(f'#!/bin/sh\nprintf "%s\\n" "$@" >{work}/said\n')
        (work / "gh").chmod(0o755)
        files = work / "files"
        (files / "wheel").mkdir(parents=True)
        (files / "wheel/alembert.whl").write_bytes(b"wheel")
        (files / f"alembert-{version}.tar.gz").write_bytes(b"sources")
        for words, why in ((("v9.9.9", files), f"expected v{version}"), ((f"v{version}", work / "none"), "no such folder")):
            refused = release(work, *words)
            if refused.returncode != 3 or why not in refused.stderr:
                yield f"not refused: {words}: {refused}"
        done = release(work, "--publish", f"v{version}", files, PATH=f"{work}:{os.environ['PATH']}",
                       GITHUB_REPOSITORY="someone/alembert", GH_TOKEN="none")
        if done.returncode:
            yield f"no release: {done.stderr}"
            return
        names = {"alembert.whl", f"alembert-{version}.tar.gz", f"alembert-{version}-recipes.tar.gz"}
        sums = dict(reversed(line.split("  ")) for line in (files / "SHA256SUMS").read_text().splitlines())
        if sums != {name: hashlib.sha256((files / name).read_bytes()).hexdigest() for name in names}:
            yield f"other checksums: {sums}"
        said = (work / "said").read_text().splitlines()
        if said[:3] != ["release", "create", f"v{version}"] or not names | {"SHA256SUMS"} <= set(said) or "Old." in said:
            yield f"released otherwise: {said}"
        yield from recipes(version, files, sums)
        (work / "CHANGELOG.md").write_text("# Changes\n\n## Unreleased\n\nMore.\n")
        if release(work, f"v{version}", files).returncode != 3:
            yield "a version of which CHANGELOG.md says nothing is released"


def recipes(version, files, sums):
    """They name the archive, its checksum and the version, and are YAML and Ruby."""
    import yaml
    with tarfile.open(files / f"alembert-{version}-recipes.tar.gz") as archive:
        conda = archive.extractfile("recipes/conda/recipe.yaml").read().decode()
        formula = archive.extractfile("recipes/homebrew/alembert.rb").read().decode()
        if archive.getmember("recipes/conda/build.sh").mode & 0o111 == 0:
            yield "recipes/conda/build.sh is not executable"
    sources = f"alembert-{version}.tar.gz"
    url = f"https://github.com/someone/alembert/releases/download/v{version}/{sources}"
    read = yaml.safe_load(conda)
    if read["source"][0] != {"url": url, "sha256": sums[sources]} or read["context"]["version"] != version:
        yield f"recipe.yaml has another source: {read['source'][0]}"
    if f'url "{url}"' not in formula or f'sha256 "{sums[sources]}"' not in formula:
        yield "alembert.rb has another source"
    for text in (conda, formula):
        if re.search(r"@[a-z0-9]+@", text):
            yield "a recipe is not filled in"
    if shutil.which("ruby"):
        checked = subprocess.run(["ruby", "-c"], input=formula, capture_output=True, text=True, check=False)
        if checked.returncode:
            yield f"alembert.rb: {checked.stderr}"


def main():
    try:
        import yaml  # noqa: F401
    except ImportError:
        print("python3-yaml is not installed: the workflows were not checked")
        return int(os.environ.get("ALEMBERT_NO_SKIP", 77))
    readme = (ROOT / "README.md").read_text(encoding="utf-8")
    found = [*faults_are_found(readme), *faults(ROOT, readme), *containers(ROOT), *releases()]
    if shutil.which("actionlint"):
        lint = subprocess.run(["actionlint", *sorted(ROOT.glob(".github/workflows/*.yml"))], capture_output=True, text=True, check=False)
        found += (lint.stdout + lint.stderr).splitlines() if lint.returncode else []
    print(*found, sep="\n")
    print("the workflows are wrong" if found else "each step of the workflows runs a script that is there; a release has its checksums")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
