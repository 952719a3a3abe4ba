"""The schemas of the other systems' formats."""

import json
from pathlib import Path
from typing import get_args

import jsonschema
import pytest

from raysteps.exports import formats

pytestmark = pytest.mark.portable

_FOLDER = Path(formats.__file__).parent / "schemas"


def test_every_format_has_its_schema() -> None:
    assert sorted(path.name for path in _FOLDER.iterdir()) == sorted(
        f"{name}.schema.json" for name in get_args(formats.Format)
    )


@pytest.mark.parametrize("name", get_args(formats.Format))
def test_schemas_are_schemas(name: str) -> None:
    schema = json.loads((_FOLDER / f"{name}.schema.json").read_text())
    jsonschema.Draft202012Validator.check_schema(schema)
    assert not jsonschema.Draft202012Validator(schema).is_valid(7)
