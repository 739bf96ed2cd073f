# SPDX-License-Identifier: MIT
# validate_schema.py SCHEMA FILE... prints "ok" or the first problem of each JSON file, a line each.
import json
import pathlib
import sys
import warnings

warnings.simplefilter("ignore", DeprecationWarning)
import jsonschema  # noqa: E402

schema_file = pathlib.Path(sys.argv[1])
schema = json.loads(schema_file.read_text())
store = {}
for other in schema_file.parent.glob("*.schema.json"):
    content = json.loads(other.read_text())
    store[content["$id"]] = content
jsonschema.Draft202012Validator.check_schema(schema)
resolver = jsonschema.RefResolver(schema["$id"], schema, store)
validator = jsonschema.Draft202012Validator(schema, resolver=resolver)
for name in sys.argv[2:]:
    problems = [p.message for p in validator.iter_errors(json.loads(pathlib.Path(name).read_text()))]
    print(problems[0].replace("\n", " ") if problems else "ok")
