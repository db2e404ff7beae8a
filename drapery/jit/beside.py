"""The process that compiles kernels while the command that started it compiles others.

`python -m drapery.jit.beside` reads a call of a kernel from standard input, see
`drapery.jit.expected_call`, and compiles the kernel for it into the cache;
`python -m drapery.jit.beside MODULE` runs a module that compiles what it needs. The process
ends with the one that started it, whose end closes standard input.
"""

import os
import pickle
import sys
import threading
from importlib import import_module


def _end_with_input() -> None:
    """End this process when standard input is closed; what it stored until then is kept."""
    while os.read(0, 1):  # not by way of `sys.stdin`, which a thread must not hold at the end
        pass
    os._exit(0)


def main(words: list[str]) -> None:
    """Compile a kernel, or run the module that the words name."""
    call = None if words else pickle.load(sys.stdin.buffer)
    threading.Thread(target=_end_with_input, daemon=True).start()
    if call is None:
        import_module(f"{words[0]}.__main__").main()
        return
    from drapery.jit.codegen import compile_kernel

    module, name, types, parameters = call
    compile_kernel(getattr(import_module(module), name), types, parameters)


if __name__ == "__main__":
    main(sys.argv[1:])
