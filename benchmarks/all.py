"""Every benchmark in its quick mode: `python -m benchmarks.all [NAME...]`; 1 if one fails."""

import subprocess
import sys
import time
from pathlib import Path

HERE = Path(__file__).parent
PARTS = ("all", "endurance", "quick", "roofline")
"""Modules that are no benchmark of their own: `cloth` runs two of them."""
LIMIT = 300.0
"""How long one may take [s]."""


def names() -> list[str]:
    """All benchmarks."""
    found = {path.stem for path in HERE.glob("*.py")}
    return sorted(found - {"__init__", *PARTS})


def fault(name: str) -> str:
    """Why a benchmark failed; empty if it did not."""
    command = [sys.executable, "-m", f"benchmarks.{name}", "--quick"]
    try:
        subprocess.run(
            command,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            check=True,
            text=True,
            timeout=LIMIT,
            cwd=HERE.parent,
        )
    except subprocess.CalledProcessError as error:
        return f"exit code {error.returncode}\n{error.stdout[-4000:]}"
    except subprocess.TimeoutExpired:
        return f"over {LIMIT:g} s"
    return ""


def main() -> int:
    """Run those that the command line names, or all."""
    failed = 0
    for name in sys.argv[1:] or names():
        start = time.monotonic()
        reason = fault(name)
        failed += bool(reason)
        print(f"{name:10} {time.monotonic() - start:5.1f} s  {reason or 'runs'}", flush=True)
    return min(failed, 1)


if __name__ == "__main__":
    sys.exit(main())
