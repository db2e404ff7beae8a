"""Every example runs and leaves pictures that show something."""

import importlib.util
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

EXAMPLES = Path(__file__).parent.parent / "examples"
SMALLER = {"crowd": {"side": 6, "seconds": 0.2}, "own_cloth": {"frames": 12}}
"""The same program on less, where the whole takes long."""


@pytest.mark.parametrize("name", sorted(path.stem for path in EXAMPLES.glob("*.py")))
def test_an_example_writes_its_pictures(name: str, tmp_path: Path) -> None:
    spec = importlib.util.spec_from_file_location(name, EXAMPLES / f"{name}.py")
    assert spec is not None and spec.loader is not None
    program = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(program)
    program.main(tmp_path, **SMALLER.get(name, {}))
    written = list(tmp_path.iterdir())
    assert written
    for path in written:
        if path.suffix != ".glb":
            with Image.open(path) as picture:
                texels = np.asarray(picture.convert("RGBA"))
            assert len(np.unique(texels.reshape(-1, 4), axis=0)) > 8, path.name


def test_every_example_is_listed() -> None:
    listed = (EXAMPLES / "README.md").read_text()
    assert all(f"`{path.name}`" in listed for path in EXAMPLES.glob("*.py"))
