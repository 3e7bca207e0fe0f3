#!/usr/bin/env python3
"""Puts the sections of a generated Markdown file into a document.

    ./run depth results/depth
    docs/fill_tables.py results/depth/depth_curves.md docs/structured_light.md

What stands between the lines <!-- TITLE --> and <!-- end --> of the document becomes the section
under "## TITLE" of the generated file.
"""
import re
import sys
from pathlib import Path


def sections_of(markdown):
    parts = re.split(r"^## (.*)$", markdown, flags=re.MULTILINE)
    return dict(zip(parts[1::2], (text.strip() for text in parts[2::2])))


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    generated, document = map(Path, sys.argv[1:])
    sections = sections_of(generated.read_text())

    def filled(match):
        title = match.group(1)
        if title not in sections:
            sys.exit(f"{generated} has no section '{title}', only {', '.join(sections)}")
        return f"<!-- {title} -->\n{sections[title]}\n<!-- end -->"

    text = document.read_text()
    text, count = re.subn(r"<!-- ((?!end).*?) -->\n.*?<!-- end -->", filled, text, flags=re.DOTALL)
    if count == 0:
        sys.exit(f"{document} has no place for a section: <!-- TITLE --> to <!-- end -->")
    document.write_text(text)


if __name__ == "__main__":
    main()
