"""What a pasted item says beside its design stays with it: its name is the title of the design."""

import pytest

from drapery.studio.panels.written import WrittenForm
from drapery.studio.session import Session


def pasted(text: str) -> Session:
    session = Session()
    session.upload_queue.read_text(text)
    session.close()
    return session


@pytest.mark.parametrize(
    "text",
    [
        """/give @p white_banner[custom_name='"Sea Star"',banner_patterns=[]]""",
        """/give @p white_banner[minecraft:custom_name='{"text":"Sea Star","italic":false}']""",
        '/give @p white_banner[custom_name={text:"Sea Star",color:"red"}]',
        '/give @p white_banner[custom_name={text:"Sea",extra:[{text:" "},"Star"]}]',
        '/give @p white_banner[custom_name=["Sea ",{text:"Star",bold:true}]]',
        '/give @p white_banner[custom_name="Sea Star"]',
        '/give @p white_banner[item_name="Sea Star"]',
        """/give @p white_banner{display:{Name:'{"text":"Sea Star"}'}}""",
        '/give @p banner 1 15 {display:{Name:"Sea Star"}}',
        '{id:"white_banner",components:{"minecraft:custom_name":"Sea Star"}}',
    ],
)
def test_a_name_is_the_title(text: str) -> None:
    assert pasted(text).upload_queue.title == "Sea Star"


def test_quotes_in_a_name() -> None:
    text = r'/give @p white_banner[custom_name={text:"My \"Best\" Flag",color:"gold"}]'
    assert pasted(text).upload_queue.title == 'My "Best" Flag'


@pytest.mark.parametrize("text", ["white creeper:lime", "custom_name=", "Name:'{\"a\":[1]}'", ""])
def test_other_texts_have_no_name(text: str) -> None:
    assert pasted(text).upload_queue.title == ""


def test_the_copied_command_is_the_pasted_one() -> None:
    text = (
        '/give @a[distance=..5] minecraft:red_banner[banner_patterns=[{pattern:"creeper",'
        r'color:"lime"}],custom_name={text:"My \"Best\" Flag",color:"gold"},lore=["one",{text:"two"'
        ',italic:false}],enchantments={"minecraft:luck":1b}] 3'
    )
    queue = pasted(text).upload_queue
    assert queue.details is not None
    assert WrittenForm(details=queue.details).text(queue.found[0].banner) == text
