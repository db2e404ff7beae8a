"""The forms that live in web addresses: pairs stated by others, round trips, refusals."""

import re

import pytest
from hypothesis import given, strategies as st

from drapery.banner.design import Banner, Layer
from drapery.banner.dyes import DYE_NAMES
from drapery.banner.formats import minecraft_tools, needcoolshoes, planet_minecraft
from drapery.banner.patterns import PATTERN_NAMES
from drapery.errors import DesignError

FORMS = [planet_minecraft, needcoolshoes, minecraft_tools]


def banner(base: str, *layers: str) -> Banner:
    return Banner(base, tuple(Layer(*layer.split()) for layer in layers))


PAIRS = [
    (
        planet_minecraft,
        "2c729cmcf28",
        banner(
            "red",
            "cross yellow",
            "diagonal_left red",
            "square_top_right yellow",
            "mojang yellow",
            "curly_border red",
        ),
    ),
    (planet_minecraft, "b1f", banner("lime", "mojang black")),
    (
        needcoolshoes,
        "ealleNhEehppai",
        banner(
            "blue",
            "stripe_center yellow",
            "globe blue",
            "stripe_top light_gray",
            "triangles_bottom blue",
            "gradient white",
            "curly_border black",
        ),
    ),
    (
        needcoolshoes,
        "paalpwpEac",
        banner(
            "white",
            "stripe_center black",
            "stripe_middle white",
            "stripe_top white",
            "border black",
        ),
    ),
    (
        minecraft_tools,
        "color_id_0=4&shape_id_1=28&color_id_1=15&shape_id_2=37&color_id_2=4",
        banner("blue", "bricks white", "half_horizontal_bottom blue"),
    ),
]


@pytest.mark.parametrize(("form", "code", "expected"), PAIRS)
def test_pairs_stated_by_others_hold(form, code: str, expected: Banner):
    assert form.parse(code) == expected
    assert form.parse(form.write(expected)) == expected
    assert form.write(expected).endswith(code)


ADDRESSES = [
    (planet_minecraft, "https://www.planetminecraft.com/banner/?b=2c729cmcf28"),
    (planet_minecraft, "http://planetminecraft.com/banner/?e=2c729cmcf28"),
    (planet_minecraft, "planetminecraft.com/banner?b=2c729cmcf28#editor"),
    (planet_minecraft, "  WWW.PlanetMinecraft.com/banner/?x=1&b=2c729cmcf28 \n"),
    (needcoolshoes, "https://www.needcoolshoes.com/banner?=ealleNhEehppai"),
    (needcoolshoes, "https://needcoolershoes.com/banner?=ealleNhEehppai"),
    (needcoolshoes, "https://ncrs.skin/b?=ealleNhEehppai"),
    (needcoolshoes, "skinmc.net/banner/editor?=ealleNhEehppai"),
    (needcoolshoes, "needcoolshoes.com/banner?page=2&=ealleNhEehppai"),
    (minecraft_tools, f"https://minecraft.tools/en/banner.php?{PAIRS[4][1]}"),
    (minecraft_tools, f"minecraft.tools/de/banner.php?{PAIRS[4][1]}#crafting"),
]


@pytest.mark.parametrize(("form", "address"), ADDRESSES)
def test_all_spellings_of_an_address_are_read(form, address: str):
    assert form.recognises(address)
    assert form.parse(address) == next(b for f, _, b in PAIRS if f is form and len(b.layers) != 1)


def test_every_form_knows_only_its_own_addresses():
    for form, address in ADDRESSES:
        assert [f for f in FORMS if f.recognises(address)] == [form]


def test_a_site_of_another_name_is_not_taken_for_ours():
    for form in FORMS:
        for text in ("https://notplanetminecraft.com/?b=b1f", "/give @p white_banner", "", "x.y"):
            assert not form.recognises(text)
            assert not form.recognises("https://evil.com/needcoolshoes.com?=pa")


GALLERIES = [
    (planet_minecraft, "https://www.planetminecraft.com/banner/union-flag/"),
    (needcoolshoes, "https://needcoolershoes.com/banners/8961/~ghost"),
    (needcoolshoes, "https://skinmc.net/banner/18d1d0c1-08fd-46a6-abfd-1766ebc47f26"),
    (minecraft_tools, "https://minecraft.tools/en/banner-gallery.php"),
]


@pytest.mark.parametrize(("form", "address"), GALLERIES)
def test_gallery_pages_carry_no_code_and_are_refused_with_a_hint(form, address: str):
    assert form.recognises(address)
    with pytest.raises(DesignError, match=r"carries no.*copy the address"):
        form.parse(address)


REFUSALS = [
    (planet_minecraft, "b1", "odd number"),
    (planet_minecraft, "b11", "'1' at character 3 .* not the code of a pattern"),
    (planet_minecraft, "b-f", "'-' at character 2 .* not the code of a dye"),
    (planet_minecraft, "https://planetminecraft.com/banner/?b=b1!", "'!' at character 3"),
    (planet_minecraft, "b" + "1f" * 17, "17 layers"),
    (needcoolshoes, "eal", "even number"),
    (needcoolshoes, "eaa/", "'/' at character 4 .* not the code of a pattern"),
    (needcoolshoes, "eaXa", "not the code of a pattern"),
    (needcoolshoes, "https://ncrs.skin/b?=ea*a", r"'\*' at character 3"),
    (needcoolshoes, "ea" + "ab" * 17, "17 layers"),
    (minecraft_tools, "color_id_0=16", "color_id_0=16 is not a dye"),
    (minecraft_tools, "color_id_0=1&shape_id_1=41&color_id_1=1", "shape_id_1=41"),
    (minecraft_tools, "color_id_0=1&shape_id_1=1", "color_id_1 is missing"),
    (minecraft_tools, "shape_id_1=1&color_id_1=1", "color_id_0 is missing"),
    (minecraft_tools, "color_id_0=-1", "color_id_0 is '-1'"),
]


@pytest.mark.parametrize(("form", "text", "place"), REFUSALS)
def test_a_refusal_is_one_line_naming_the_place(form, text: str, place: str):
    with pytest.raises(DesignError) as caught:
        form.parse(text)
    assert re.search(place, str(caught.value))
    assert "\n" not in str(caught.value) and len(str(caught.value)) < 300


def test_the_base_pair_may_carry_other_high_bits():
    # X is place 49: dye 49 & 15 = 1, red.
    assert needcoolshoes.parse("Xa") == Banner("red")


def test_shape_zero_is_not_a_layer():
    assert minecraft_tools.parse("color_id_0=4&shape_id_1=0&color_id_1=0") == Banner("blue")


def test_minecraft_tools_edits_shields_too():
    shield = Banner("blue", (Layer("bricks", "white"),), kind="shield")
    address = "https://minecraft.tools/en/shield.php?color_id_0=4&shape_id_1=28&color_id_1=15"
    assert minecraft_tools.parse(address) == shield
    assert minecraft_tools.write(shield) == address


@pytest.mark.parametrize(
    ("form", "lacks"),
    [
        (planet_minecraft, {"base"}),
        (needcoolshoes, set()),
        (minecraft_tools, {"base", "flow", "guster"}),
    ],
)
def test_a_site_holds_all_patterns_but_these(form, lacks: set[str]):
    order = form.PATTERN_ORDER
    assert len(order) == len(set(order))
    assert set(PATTERN_NAMES) - set(order) == lacks and set(order) <= set(PATTERN_NAMES)
    for pattern in (*lacks, "mymod:rose"):
        with pytest.raises(DesignError, match=f"no code for pattern '{pattern}'"):
            form.write(Banner("white", (Layer(pattern, "red"),)))


DYES = st.sampled_from(DYE_NAMES)


@pytest.mark.parametrize("form", FORMS)
def test_every_banner_that_a_site_holds_comes_back(form):
    layers = st.builds(Layer, st.sampled_from(form.PATTERN_ORDER), DYES)

    @given(st.builds(Banner, DYES, st.lists(layers, max_size=16).map(tuple)))
    def round_trip(design: Banner):
        address = form.write(design)
        assert form.recognises(address) and form.parse(address) == design

    round_trip()


@pytest.mark.parametrize("form", FORMS)
@given(st.text(max_size=60) | st.from_regex(r"(https://)?[a-z.]{0,9}[/?=&b]{0,5}[!-~]{0,40}"))
def test_any_text_is_a_banner_or_a_refusal(form, text: str):
    for candidate in (text, f"https://{ADDRESSES[0][1][12:32]}/?b={text}"):
        try:
            assert isinstance(form.parse(candidate), Banner)
        except DesignError as error:
            assert "\n" not in str(error)
