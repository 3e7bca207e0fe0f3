#!/usr/bin/python3
"""Runs every comparison with another program and writes what they say into results.md beside.

A peer that is not installed keeps the result that is there. Exits 0 if all that ran agree, else 1.
"""

import argparse
import os
import pathlib
import re
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
RESULTS = HERE / "results.md"
SKIPPED = 77
HEADING = "# What the other programs said last\n\nWritten by `tests/peers/run_all.py`; see [README](README.md).\n"


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--fenestra", required=True, type=pathlib.Path, help="the program")
    parser.add_argument("--samples", type=int, default=256, help="of Cycles, per pixel and seed")
    parser.add_argument("--out", type=pathlib.Path, help="folder for Cycles' images; else none stay")
    parser.add_argument("--reuse", action="store_true",
                        help="take Cycles' images that --out has: they do not change with Fenestra")
    parser.add_argument("--emva1288", type=pathlib.Path, help="folder 'src' of the EMVA1288 package")
    parser.add_argument("--peers", nargs="+", choices=("cycles", "emva1288"),
                        default=("cycles", "emva1288"))
    return parser.parse_args()


def first_line(*command):
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    return done.stdout.splitlines()[0] if done.returncode == 0 and done.stdout else ""


def commands_of(arguments, out):
    """Of each peer: the command and what it runs against."""
    fenestra = arguments.fenestra.resolve()
    cycles = [HERE / "cycles" / "compare.py", "--fenestra", fenestra, "--out", out,
              "--samples", arguments.samples, *(["--reuse"] if arguments.reuse else [])]
    emva = [HERE / "emva1288" / "compare.py", "--fenestra", fenestra]
    return {"cycles": cycles, "emva1288": emva}


def version_of(peer, arguments):
    if peer == "cycles":
        return f"{first_line('blender', '--version')}, {arguments.samples} samples and two seeds"
    return "EMVA1288 package, release 4.0"


def stored_sections():
    if not RESULTS.exists():
        return {}
    parts = re.split(r"^## (\S+)\n", RESULTS.read_text(encoding="utf-8"), flags=re.MULTILINE)
    return dict(zip(parts[1::2], parts[2::2]))


def section_of(peer, arguments, done):
    verdict = "agrees" if done.returncode == 0 else "DISAGREES"
    version = first_line(str(arguments.fenestra), "--version")
    return (f"\n{version}; {version_of(peer, arguments)}: {verdict}.\n\n```\n"
            f"{done.stdout.rstrip()}\n```\n\n")


def main():
    arguments = parse_arguments()
    sections = stored_sections()
    environment = dict(os.environ)
    if arguments.emva1288:
        environment["PYTHONPATH"] = str(arguments.emva1288.resolve())
    agree = True
    with tempfile.TemporaryDirectory() as temporary:
        commands = commands_of(arguments, arguments.out or temporary)
        for peer in arguments.peers:
            command = [str(part) for part in commands[peer]]
            done = subprocess.run(command, capture_output=True, text=True, check=False,
                                  env=environment)
            sys.stdout.write(done.stdout)
            sys.stderr.write(done.stderr)
            if done.returncode == SKIPPED:
                continue
            agree &= done.returncode == 0
            sections[peer] = section_of(peer, arguments, done)
    body = "".join(f"\n## {peer}\n{text.rstrip()}\n" for peer, text in sorted(sections.items()))
    RESULTS.write_text(HEADING + body, encoding="utf-8")
    sys.exit(0 if agree else 1)


main()
