"""The JSON schemas that the kit's classes give."""

import json
from pathlib import Path

import jsonschema
import pytest
from export_documents import full, mixed

from raysteps.common.documents import plain
from raysteps.course.manifest import Step
from tools.schemas import DOCUMENTS, schema_of, write_schemas

pytestmark = pytest.mark.portable


def test_each_document_has_one(tmp_path: Path) -> None:
    paths = write_schemas(tmp_path / "schemas")
    assert [path.name for path in paths] == [f"{name}.schema.json" for name in DOCUMENTS]
    for path in paths:
        jsonschema.Draft202012Validator.check_schema(json.loads(path.read_text(encoding="utf-8")))


def test_it_takes_what_the_kit_writes_and_nothing_else(steps: list[Step]) -> None:
    check = jsonschema.Draft202012Validator(schema_of(DOCUMENTS["results"]))
    for made in (full(steps), mixed(steps)):
        document = plain(made)
        check.validate(document)
        assert isinstance(document, dict)
        assert not check.is_valid(document | {"more": 1})
        assert not check.is_valid(document | {"steps": [document["steps"][0] | {"more": 1}]})
        assert not check.is_valid(document | {"timing": {"seconds": -1, "cpu_seconds": 1}})
