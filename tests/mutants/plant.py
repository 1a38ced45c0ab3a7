"""Writes all mutants of a room into one copy of the source, chosen at run time by their number.

A mutant is the code with one small error. `plant` copies the tracked files to a folder and rewrites
the Rust files below the given paths: `a - b` becomes `mutant_or!(17, -, +, (a), (b))`, which
computes `a + b` if the environment says MUTANT=17. So one build does for thousands of mutants.

With MUTANT=trace:FILE no mutant is alive, and the process writes one byte for each of them to FILE:
bit 0 if it was reached, bit 1 if its result would have been another. A test that does neither
cannot kill it.
"""

import json
import re
import subprocess
from pathlib import Path

import tree_sitter
import tree_sitter_rust

PARSER = tree_sitter.Parser(tree_sitter.Language(tree_sitter_rust.language()))

ARITHMETIC = {"+": "-", "-": "+", "*": "/", "/": "*", "%": "*"}
COMPARISONS = {
    "<": ["<=", ">"],
    ">": [">=", "<"],
    "<=": ["<", ">"],
    ">=": [">", "<"],
    "==": ["!="],
    "!=": ["=="],
}
ASSIGNMENTS = {"+=": "-=", "-=": "+=", "*=": "/=", "/=": "*="}
NUMBERS = {"f64": ["0.0", "1.0", "-1.0"], "i64": ["0", "1", "-1"], "i32": ["0", "1", "-1"]}
VALUES = {
    "bool": ["true", "false"],
    "()": ["()"],
    "String": ["String::new()"],
    "fmt::Result": ["Ok(())"],
}
VALUES |= NUMBERS | {unsigned: ["0", "1"] for unsigned in ("usize", "u64", "u32")}

# What has no value at run time, or must keep its text.
LEFT = {
    "macro_invocation",
    "macro_definition",
    "const_item",
    "static_item",
    "attribute_item",
    "const_block",
    "inner_attribute_item",
    "use_declaration",
    "array_type",
    "type_arguments",
    "enum_item",
    "struct_item",
    "type_item",
    "where_clause",
    "type_parameters",
    "line_comment",
    "block_comment",
    "parameters",
}


def parts(text):
    """The parts of a list of types, at its outermost commas."""
    found, depth, current = [], 0, ""
    for letter in text:
        depth += (letter in "([<") - (letter in ")]>")
        if letter == "," and depth == 0:
            found.append(current.strip())
            current = ""
        else:
            current += letter
    return found + ([current.strip()] if current.strip() else [])


def defaults(kind):
    """Values that a function of this type may return in place of its own."""
    kind = " ".join(kind.split())
    if kind in VALUES:
        return VALUES[kind]
    if option := re.fullmatch(r"Option<(.*)>", kind):
        inner = option[1]
        return ["None"] + (
            [f"Some({value})" for value in defaults(inner)] if inner in VALUES else []
        )
    if result := re.fullmatch(r"(?:crate::)?(?:error::)?Result<(.*)>", kind):
        return [f"Ok({value})" for value in defaults(parts(result[1])[0])]
    if re.fullmatch(r"Vec<.*>", kind):
        return ["Vec::new()"]
    if re.fullmatch(r"&(?:'\w+ )?\[.*\]", kind):
        return ["&[]"]
    if array := re.fullmatch(r"\[(f64|bool|usize); (.+)\]", kind):
        return [f"[{value}; {array[2]}]" for value in VALUES[array[1]][:2]]
    if group := re.fullmatch(r"\((.*)\)", kind):
        values = [defaults(part) for part in parts(group[1])]
        return ["(" + ", ".join(value[0] for value in values) + ")"] if all(values) else []
    return ['""'] if re.fullmatch(r"&(?:'\w+ )?str", kind) else []


class File:
    """One source file while it is rewritten; `mutants` is the list of all, which it extends."""

    def __init__(self, root, path, mutants, skip):
        self.path, self.bytes, self.mutants, self.skip = (
            path,
            (root / path).read_bytes(),
            mutants,
            skip,
        )
        self.names = []

    def rewritten(self):
        return self.emit(PARSER.parse(self.bytes).root_node)

    def text(self, node):
        return self.bytes[node.start_byte : node.end_byte].decode()

    def mutant(self, node, kind, change):
        """The number of a new mutant at a node; None for one that does not compile."""
        row, column = node.start_point
        if (self.path, row + 1, column + 1, kind) in self.skip:
            return None
        line = self.bytes.split(b"\n")[row].decode().strip()
        number = len(self.mutants) + 1
        place = [row + 1, column + 1]
        entry = {
            "id": number,
            "file": self.path,
            "line": place[0],
            "column": place[1],
            "place": place,
            "kind": kind,
        }
        self.mutants.append(
            entry | {"function": "::".join(self.names), "change": change, "source": line}
        )
        return number

    def inside(self, node):
        """The node with its children rewritten, but for tests."""
        out, at, test = [], node.start_byte, False
        for child in node.children:
            out.append(self.bytes[at : child.start_byte].decode())
            at = child.end_byte
            if child.type == "attribute_item":
                test = (
                    test or "cfg(test)" in self.text(child) or self.text(child).strip() == "#[test]"
                )
                out.append(self.text(child))
            elif test and not child.type.endswith("comment"):
                out.append(self.text(child))
                test = False
            else:
                out.append(self.emit(child))
        return "".join(out) + self.bytes[at : node.end_byte].decode()

    def sides(self, node):
        left, right = node.child_by_field_name("left"), node.child_by_field_name("right")
        return left, right, self.text(node.child_by_field_name("operator"))

    def emit(self, node):
        kind = node.type
        if (
            not node.children
            or kind in LEFT
            or (kind.endswith("_pattern") and kind != "match_pattern")
        ):
            return self.text(node)
        special = getattr(self, f"emit_{kind}", None)
        return special(node) if special else self.inside(node)

    def emit_match_pattern(self, node):
        condition = node.child_by_field_name("condition")
        if condition is None or b"let " in self.bytes[condition.start_byte : condition.end_byte]:
            return self.text(node)
        before = self.bytes[node.start_byte : condition.start_byte].decode()
        always, never = (
            self.mutant(condition, f"guard {word}", word) for word in ("true", "false")
        )
        inner = self.emit(condition)
        inner = f"(crate::mutant({always}) || ({inner}))" if always else inner
        return before + (f"(!crate::mutant({never}) && {inner})" if never else inner)

    def emit_let_declaration(self, node):
        out, at = [], node.start_byte
        for field in ("value", "alternative"):
            child = node.child_by_field_name(field)
            if child is not None:
                out += [self.bytes[at : child.start_byte].decode(), self.emit(child)]
                at = child.end_byte
        return "".join(out) + self.bytes[at : node.end_byte].decode()

    def emit_impl_item(self, node):
        of = node.child_by_field_name("trait")
        self.names.append(
            (self.text(of) + " for " if of else "") + self.text(node.child_by_field_name("type"))
        )
        inner = self.inside(node)
        self.names.pop()
        return inner

    def emit_function_item(self, node):
        body, returned = node.child_by_field_name("body"), node.child_by_field_name("return_type")
        head = self.bytes[node.start_byte : body.start_byte].decode()
        if re.search(r"\bconst\s+(unsafe\s+)?fn\b", head):
            return self.text(node)
        self.names.append(self.text(node.child_by_field_name("name")))
        own, early = self.text(body)[1:-1].strip(), ""
        for index, value in enumerate(defaults(self.text(returned)) if returned else ["()"]):
            number = self.mutant(node, f"body {index}", value) if own and value != own else None
            early += f" if crate::mutant({number}) {{ return {value}; }}" if number else ""
        inner = self.inside(body)
        self.names.pop()
        return head + "{" + early + inner[1:]

    def emit_binary_expression(self, node):
        left, right, operator = self.sides(node)

        def change(kind, other):
            return self.mutant(node, kind, f"{operator} to {other}")

        before = len(self.mutants)
        if operator in ARITHMETIC:
            other = ARITHMETIC[operator]
            number = change("arithmetic", other)
            made = f"mutant_or!({number}, {operator}, {other}" if number else None
        elif operator in COMPARISONS:
            numbers = [
                (change(f"comparison {other}", other), other) for other in COMPARISONS[operator]
            ]
            listed = "".join(f", {number} {other}" for number, other in numbers if number)
            made = f"mutant_compares!({operator}{listed}" if listed else None
        elif operator in ("&&", "||"):
            chain = any(side.type == "let_condition" for side in (left, right))
            number = None if chain else change("logic", "||" if operator == "&&" else "&&")
            made = (
                f"mutant_{'and' if operator == '&&' else 'or_else'}!({number}" if number else None
            )
        else:
            return self.inside(node)
        for entry in self.mutants[before:]:
            entry["column"] = node.child_by_field_name("operator").start_point[1] + 1
            entry["line"] = node.child_by_field_name("operator").start_point[0] + 1
        sides = self.emit(left), self.emit(right)
        mark = ";" if operator in COMPARISONS else ","
        return (
            f"{made}{mark} ({sides[0]}), ({sides[1]}))"
            if made
            else self.joined(node, left, right, sides)
        )

    def emit_compound_assignment_expr(self, node):
        left, right, operator = self.sides(node)
        other, sides = ASSIGNMENTS.get(operator), (self.emit(left), self.emit(right))
        number = self.mutant(node, "assignment", f"{operator} to {other}") if other else None
        if number is None:
            return self.joined(node, left, right, sides)
        return f"mutant_assigns!({number}, {operator}, {other}, {sides[0]}, {sides[1]})"

    def emit_unary_expression(self, node):
        operator, inner = node.children[0].type, node.children[-1]
        if operator not in ("-", "!"):
            return self.inside(node)
        number, inner = self.mutant(node, "unary", f"{operator} left out"), self.emit(inner)
        return f"mutant_unary!({number}, {operator}, ({inner}))" if number else operator + inner

    def joined(self, node, left, right, sides):
        middle = self.bytes[left.end_byte : right.start_byte].decode()
        return sides[0] + middle + sides[1] + self.bytes[right.end_byte : node.end_byte].decode()


def is_source(path):
    """Whether a file is Rust and no test: those of `tests.rs` and of folders `tests` are compiled
    for tests only."""
    return path.endswith(".rs") and "tests" not in Path(path).with_suffix("").parts


def plant(root, copy, paths, skip=frozenset()):
    """Copies the repository at `root` to `copy`, with all mutants of the files below `paths`. Those
    in `skip` (file, line, column, kind), which do not compile, are left out."""
    copy.mkdir(parents=True, exist_ok=True)
    archive = subprocess.run(["git", "archive", "HEAD"], cwd=root, capture_output=True, check=True)
    subprocess.run(["tar", "x", "-C", copy], input=archive.stdout, check=True)
    listed = subprocess.run(
        ["git", "ls-files", *paths], cwd=root, capture_output=True, check=True, text=True
    )
    mutants = []
    for path in (path for path in listed.stdout.split() if is_source(path)):
        (copy / path).write_text(File(copy, path, mutants, skip).rewritten())
    chosen = (
        (Path(__file__).parent / "chosen.rs")
        .read_text()
        .replace("COUNT_OF_MUTANTS", str(len(mutants)))
    )
    top = (copy / "src/lib.rs").read_text()
    (copy / "src/lib.rs").write_text(top.replace("#![forbid(unsafe_code)]", chosen))
    (copy / "mutants.json").write_text(json.dumps(mutants))
    return mutants
