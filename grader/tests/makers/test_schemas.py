"""The JSON schemas that the kit's classes give."""

import json
from dataclasses import fields
from pathlib import Path
from typing import cast

import jsonschema
import pytest
from export_documents import full, mixed

from raysteps.common.documents import plain
from raysteps.course.manifest import Step
from raysteps.results.model import Results
from tools.dev import DOCUMENTS, schema_of, write_schemas

pytestmark = pytest.mark.portable
_OPTIONAL = {field.name for field in fields(Results) if field.metadata}


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
        assert check.is_valid(document | {"inconsistent": True}), "older kits wrote it"
        assert not check.is_valid(document | {"steps": [document["steps"][0] | {"more": 1}]})
        assert not check.is_valid(document | {"timing": {"seconds": -1, "cpu_seconds": 1}})
        for left_out in document:
            is_optional = left_out in _OPTIONAL
            assert check.is_valid({key: told for key, told in document.items() if key != left_out}) == is_optional


def test_what_older_kits_did_not_write_or_only_they_did_may_be_missing_inside_too() -> None:
    forms = cast(dict[str, dict[str, list[str]]], schema_of(DOCUMENTS["class"])["$defs"])
    missing = {
        name: set(form["properties"]) - set(form["required"]) for name, form in forms.items() if "properties" in form
    }
    assert {name: keys for name, keys in missing.items() if keys} == {
        "GradedSubmission": {"mistakes", "seconds", "earlier", "review", "inconsistent", "not_taken"},
        "EarlierResult": {"resubmitted"},
        "PointsChange": {"resubmitted"},
        "ClassResults": {"course", "inconsistent"},
        "EarlierSubmission": {"number"},
    }
