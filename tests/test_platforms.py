"""Commands work without the calls and modules that only POSIX systems have.

This simulates their absence. multiprocessing itself needs `signal.SIGKILL` and `os.kill` here; what
workers do without `resource` and `os.sysconf` is in `test_batch_executor`.
"""

import subprocess
import sys
from pathlib import Path

import pytest

pytestmark = pytest.mark.usefixtures("untraced_processes")

PROGRAM = """
import os, signal, sys

missing = ("fork", "register_at_fork", "getuid", "geteuid", "fchmod", "mkfifo")
for name in (*missing, "killpg", "getpgid", "sched_getaffinity"):
    if hasattr(os, name):
        delattr(os, name)
for name in ("SIGHUP", "SIGALRM", "pthread_sigmask", "setitimer", "alarm"):
    if hasattr(signal, name):
        delattr(signal, name)
sys.modules.update(dict.fromkeys(("fcntl", "grp", "pwd", "termios")))

if __name__ == "__main__":
    from drapery.cli import main

    main()
"""

COMMANDS = {
    "render": ["white", "-o", "out.png", "--size", "32x32"],
    "animate": ["white", "-o", "out.gif", "--size", "32x32", "--seconds", "0.2"],
    "batch": ["jobs.csv", "-o", "out", "--workers", "1"],
    "doctor": [],
}


@pytest.mark.parametrize("command", COMMANDS)
def test_commands_run_without_what_only_posix_has(command: str, tmp_path: Path) -> None:
    program = tmp_path / "program.py"
    program.write_text(PROGRAM, encoding="utf-8")
    jobs = "out,design,size\na.png,white,32x32\n"
    (tmp_path / "jobs.csv").write_text(jobs, encoding="utf-8")
    line = [sys.executable, str(program), command, *COMMANDS[command]]
    ran = subprocess.run(line, cwd=tmp_path, capture_output=True, encoding="utf-8", timeout=300)
    assert "Traceback" not in ran.stderr
    assert ran.returncode == 0, ran.stderr
