"""The readers and writers of the component and the designer under node, one text after another."""

import atexit
import json
import random
import shutil
import subprocess
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

from drapery.banner import DYE_NAMES, PATTERN_NAMES, Banner, Layer

NODE = shutil.which("node")
COMPONENT = Path(__file__).parents[1] / "drapery" / "web" / "component"
_SCRIPT = """
import { createInterface } from "node:readline";
import { nameOf, numberOf } from "component/attributes.js";
import { readDesign } from "component/design.js";
import { TABLES } from "component/tables.js";
import { writeCommand } from "component/../designer/commands.js";
import { shownOf, writeHash } from "component/../designer/model.js";
import { materials } from "component/../designer/loom.js";
import { readPasted } from "component/../designer/pasted.js";

// As the page that `drapery web` writes reads its address.
function readHash(hash) {
  try {
    return readDesign(decodeURIComponent(hash.slice(1)));
  } catch (error) {
    if (error instanceof URIError) return readDesign(hash.slice(1));
    throw error;
  }
}
// A pasted text as the commands of all versions that can hold it.
function rewritten(text) {
  const { work, left } = readPasted(text);
  const written = (version) => {
    try {
      return writeCommand(version, shownOf(work), work.item);
    } catch (error) {
      if (error.constructor.name === "FormError") return null;
      throw error;
    }
  };
  const versions = ["1.21.5", "1.20.5", "1.13", "1.8", "bedrock"];
  const design = shownOf(work);
  return { design, texts: versions.map(written), hash: writeHash(design), left };
}
const READERS = {
  pasted: rewritten,
  design: readDesign,
  hash: readHash,
  materials: (text) => materials(readDesign(text)),
  kind: (text) => nameOf("kind", text, TABLES.placements),
  wind: (text) => numberOf("wind", text) ?? null,
  direction: (text) => numberOf("direction", text) ?? null,
};
const now = () => Object.values(process.cpuUsage()).reduce((a, b) => a + b) / 1e6;
for await (const line of createInterface({ input: process.stdin })) {
  const [what, text] = JSON.parse(line);
  const start = now();
  const answer = {};
  try {
    answer.found = READERS[what](text);
  } catch (error) {
    Object.assign(answer, { error: error.constructor.name, message: error.message });
  }
  console.log(JSON.stringify({ ...answer, seconds: now() - start }));
}
"""


@dataclass(frozen=True)
class Answer:
    """What the component makes of a text.

    found: a design or value, or None. error, message: of the error that it throws, or "".
    seconds: of processor time.
    """

    seconds: float
    found: Any = None
    error: str = ""
    message: str = ""


@cache
def _process() -> "subprocess.Popen[str]":
    script = _SCRIPT.replace("component/", f"{COMPONENT.as_uri()}/")
    command = [str(NODE), "--input-type=module", "-e", script]
    pipe = subprocess.PIPE
    node = subprocess.Popen(command, stdin=pipe, stdout=pipe, text=True, encoding="utf-8")
    atexit.register(_end, node)
    return node


def _end(node: "subprocess.Popen[str]") -> None:
    with node:  # closes its input, whose end it waits for
        pass


def read_in_page(what: str, text: str) -> Answer:
    """Read a text as a `design`, a `hash`, an attribute `kind`, `wind` or `direction`, or as what
    is `pasted` into the designer.

    The process ends with this one.
    """
    node = _process()
    assert node.stdin is not None and node.stdout is not None
    node.stdin.write(json.dumps([what, text]) + "\n")
    node.stdin.flush()
    return Answer(**json.loads(node.stdout.readline()))


def plain(banner: Banner) -> dict[str, object]:
    """A banner as the component's designs are."""
    layers = [{"pattern": layer.pattern, "dye": layer.dye} for layer in banner.layers]
    return {"base": banner.base, "layers": layers, "kind": banner.kind}


def some_banners() -> Iterator[Banner]:
    """Every pattern and dye, and designs of any number of layers."""
    for start in range(0, len(PATTERN_NAMES), 8):
        layers = [Layer(name, DYE_NAMES[n]) for n, name in enumerate(PATTERN_NAMES[start:][:8])]
        yield Banner(DYE_NAMES[start // 3], tuple(layers))
    chance = random.Random(4)
    for count in range(17):
        layers = [
            Layer(chance.choice(PATTERN_NAMES), chance.choice(DYE_NAMES)) for _ in range(count)
        ]
        yield Banner(
            chance.choice(DYE_NAMES), tuple(layers), "shield" if count % 3 == 2 else "banner"
        )
    yield Banner("white", (Layer("acme:anvil", "red"),))
