"""The name of a pasted item is the title of its design."""

import pytest

from drapery.studio.item_names import item_name
from drapery.studio.session import Session


@pytest.mark.parametrize(
    "text",
    [
        """/give @p white_banner[custom_name='"Sea Star"',banner_patterns=[]]""",
        """/give @p white_banner[minecraft:custom_name='{"text":"Sea Star","italic":false}']""",
        '/give @p white_banner[custom_name={text:"Sea Star",color:"red"}]',
        '/give @p white_banner[custom_name="Sea Star"]',
        """/give @p white_banner{display:{Name:'{"text":"Sea Star"}'}}""",
        '{id:"white_banner",components:{"minecraft:custom_name":"Sea Star"}}',
    ],
)
def test_a_name_is_found(text: str) -> None:
    assert item_name(text) == "Sea Star"


@pytest.mark.parametrize("text", ["white creeper:lime", "custom_name=", "Name:'{\"a\":[1]}'", ""])
def test_other_texts_have_no_name(text: str) -> None:
    assert item_name(text) == ""


def test_the_name_comes_with_the_design() -> None:
    session = Session()
    session.upload_queue.read_text("""/give @p white_banner[custom_name='"Sea Star"']""")
    assert session.upload_queue.title == "Sea Star"
    session.close()
