"""The comparison of files between machines passes a rounding of the last digit and nothing else."""

import json

import pytest
from agreement import assert_same_document, assert_same_table

TABLE = "time_s,x_m\n0,0.12\n0.5,-0.70\n"


@pytest.mark.parametrize(
    "made, same",
    [
        (TABLE, True),
        (TABLE.replace("0.12", "0.13"), True),
        (TABLE.replace("-0.70", "-0.69"), True),
        (TABLE.replace("0.12", "0.14"), False),
        (TABLE.replace("0.12", "0.121"), False),
        (TABLE.replace("x_m", "x_mm"), False),
        (TABLE + "1,0.10\n", False),
        (TABLE.replace("0.5,", ""), False),
    ],
)
def test_tables(tmp_path, made, same):
    (tmp_path / "a").write_text(made)
    (tmp_path / "b").write_text(TABLE)
    if same:
        assert_same_table(tmp_path / "a", tmp_path / "b")
    else:
        with pytest.raises(AssertionError):
            assert_same_table(tmp_path / "a", tmp_path / "b")


@pytest.mark.parametrize(
    "made, same",
    [
        ({"k": [1.23456, "word"]}, True),
        ({"k": [1.23457, "word"]}, True),
        ({"k": [1.23459, "word"]}, False),
        ({"k": [1.23456, "sword"]}, False),
        ({"k": [1.23456]}, False),
        ({"j": [1.23456, "word"]}, False),
    ],
)
def test_documents(tmp_path, made, same):
    (tmp_path / "a").write_text(json.dumps(made))
    (tmp_path / "b").write_text(json.dumps({"k": [1.23456, "word"]}))
    if same:
        assert_same_document(tmp_path / "a", tmp_path / "b")
    else:
        with pytest.raises(AssertionError):
            assert_same_document(tmp_path / "a", tmp_path / "b")
