"""Values that no option expects, for sweeps over all options of each door."""

import random
from collections.abc import Iterator

LONG = 9000
"""So long are long texts [characters]; a query holds several of them."""
TEXTS = (
    *(
        "",
        " ",
        "\0",
        "a\0b",
        "\n",
        "a\nb",
        "\r\n",
        "\x1b[31m",
        "\x7f",
        "é",
        "\U0001f600",
        "\ufeff1",
    ),
    *("0", "-0", "-1", "1.5", "1e3", "1e999", "-1e999", "nan", "NaN", "inf", "-inf", "Infinity"),
    *(
        "9" * 400,
        "9" * LONG,
        "0." + "0" * LONG + "1",
        "1" + "e9" * 20,
        "0x10",
        "1_0",
        "١",
        "²",
        "1,5",
    ),
    *("true", "null", "None", "[]", "{}", "[1]", '{"a":1}', "[" * LONG, "{a:" * 2000, "(" * LONG),
    *(
        "a" * LONG,
        " " * LONG,
        "a " * 3000,
        "+" * LONG,
        ";" * LONG,
        "," * LONG,
        ":" * LONG,
        "x" * 300,
    ),
    *(
        "walk+" * 1500 + "walk",
        "walk:1," * 1000 + "walk:1",
        "walk:nan",
        "walk:1e999",
        "+",
        ":",
        "walk+",
    ),
    *("../x", "../../etc/passwd", "/etc/passwd", "/dev/zero", "C:\\x", "\\\\host\\x", "file:///x"),
    *(
        "//host/x",
        "https://example.com/x",
        "~/x",
        "a.toml",
        "/a.toml",
        "a.json",
        "/x\0.json",
        "a.png",
    ),
    *(
        "a" * 300 + ".json",
        "a" * 300 + ".toml",
        "a" * 300 + ".png",
        "x/" * 3000 + "a.json",
        "a:b/../c",
    ),
    *("__class__", "constructor", "%s%n{0}", "{0.__class__}", "$(x)", "`x`", "' or 1", "<b>"),
    *("1x1", "x", "1x", "-1x-1", "9999999x9999999", "0x0", "1x1x1", "nanxnan", "1e9x1"),
    *("#000000", "#gggggg", "transparent", "red;red", "coast:gold", "helmet:iron,", "a=b&c=d"),
)
VALUES: tuple[object, ...] = (
    *TEXTS,
    *(None, True, False, 0, -1, 2**31, 2**63, 10**400, 10**5000, -(10**5000), 1.5, 1e308),
    *(float("nan"), float("inf"), float("-inf"), [], {}, [[]], [None], [{}], {"a": 1}, {"": []}),
    *(
        [1, 2],
        [1, 2, 3],
        ["a"] * 1000,
        [["a"]] * 9,
        {"velocity": [1]},
        {1: 2},
        b"",
        b"\xff",
        (),
        object(),
    ),
)
"""Those, and what JSON, TOML, YAML or a program can give in place of a text."""


def changed_texts(count: int, seed: int) -> Iterator[str]:
    """Texts made of two to four of these."""
    rng = random.Random(seed)
    for _ in range(count):
        yield rng.choice(("", "+", ";", ",", ":", "x", "/", " ")).join(
            rng.choice(TEXTS)[:LONG] for _ in range(rng.randint(2, 4))
        )[:LONG]
