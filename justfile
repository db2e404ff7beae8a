# The commands that people need here. `just` lists them; without it, type a line as it stands.
# `pip install rust-just` installs it. Words after a name are passed on: `just test tests/batch -x`.
set windows-shell := ["powershell.exe", "-NoLogo", "-Command"]

_list:
    @just --list --unsorted

# Install the package and all tools, with the versions of the gate
install:
    pip install -e ".[dev,docs,release]" -c constraints.txt --config-settings editable_mode=strict

# Run the 300 tests that show in a minute that the core is right
quick:
    pytest -m quick

# Run all tests but those in a browser and slow ones, or those of a file
test *words:
    pytest {{words}}

# Accept the new pictures of golden tests; look at them with `git diff`
accept *words:
    pytest --drapery-update {{words}}

# Write sources as ruff formats them, and name what it cannot mend
lint:
    ruff format .
    ruff check --fix .

# Check types, of the package as it is installed
types:
    .ci/types

# Write the generated parts of pages anew, after a change of an option or docstring
tables:
    python docs/tables.py

# Show the site of the docs while you write
site:
    properdocs serve -f mkdocs.yml

# Compile the kernels that pages play to WebAssembly
pages:
    python -m drapery.web.wasm.build

# Run the gate: all tests but those in a browser and slow ones, the linters and mypy, in a fresh environment
gate:
    .ci/run
