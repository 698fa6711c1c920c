"""Places of a C++ source where a small change can be put in behind a switch, found in its text."""
import re

ON = "courant_mutants::on({n})"
SKIPPED_LINE = re.compile(r"\b(constexpr|static_assert|assert|template|using|case|enum|operator|struct|class|requires|concept|typename)\b"
                          r"|fmt::|\.(error|warn|warning|note|hint)\(|throw |Diagnostic|\bhint\b|\bmessage\b|RegisterKeyword")
STARTS_NO_EXPRESSION = re.compile(r"(return|const|auto|if|for|while|switch|case|default|using|struct|class|template|typedef|static|"
                                  r"public|private|protected|else|do|goto|throw|friend|namespace|extern|inline|virtual|try|catch|enum)\b")
DECLARATION = re.compile(r"[A-Za-z_][\w:]*(<[^;=]*>)?[&*\s]+[A-Za-z_]\w*\s*([=;({\[,]|$)")
COMPARISONS = {"<": "ToEqualToo", "<=": "ToEqualToo", ">": "ToEqualToo", ">=": "ToEqualToo", "==": "ToOpposite", "!=": "ToOpposite"}


def masked(text):
    """The text with comments, strings, characters and lines of the preprocessor blanked: of the same length."""
    pattern = re.compile(r'//[^\n]*|/\*.*?\*/|R"(\w*)\(.*?\)\1"|"(?:\\.|[^"\\\n])*"|(?<![0-9A-Fa-f])\'(?:\\.|[^\'\\\n])+\'|^[ \t]*#(?:\\\n|[^\n])*',
                         re.S | re.M)

    def blank(match):
        inner = match.group(0)
        filler = "~" if inner[0] in "R\"'" else " "  # a text stays something
        return re.sub(r"[^\n]", filler, inner)

    return pattern.sub(blank, text)


def closing(text, at):
    """Where the bracket that opens at `at` is closed; -1 where it is not."""
    depth = 0
    for k in range(at, len(text)):
        if text[k] in "([{":
            depth += 1
        elif text[k] in ")]}":
            depth -= 1
            if depth == 0:
                return k
    return -1


def operand_end(text, at):
    """End of the operand of && or || that begins at `at`."""
    k = at
    while k < len(text):
        if text[k] in "([{":
            k = closing(text, k)
            if k < 0:
                return -1
        elif text[k] in ")]};,?" or text.startswith(("&&", "||"), k) or (text[k] == ":" and " " in text[k - 1]):
            return k
        k += 1
    return -1


def statement_end(text, at):
    k = at
    while k < len(text):
        if text[k] in "([{":
            if text[k] == "{" and text[at:k].rstrip().endswith(")") and "[" not in text[at:k]:
                return -1  # the head of a block
            k = closing(text, k)
            if k < 0:
                return -1
        elif text[k] == ";":
            return k + 1
        elif text[k] in ")]}":
            return -1
        k += 1
    return -1


def places(text):
    """(kind, begin, end, replacement with {n} for the number of the change) of all locations."""
    mask = masked(text)
    found = []

    def add(kind, begin, end, new):
        found.append((kind, begin, end, new))

    for m in re.finditer(r"(?<=[\w)\]]) ([+-]) (?=[\w(])", mask):
        add("sign", m.start(1), m.end(1), m[1] + " courant_mutants::Sign{{{n}}} *")
    for m in re.finditer(r"(?:(?<=return )|(?<== )|(?<=, )|(?<=\())-(?=[\w(])", mask):
        add("sign", m.start(), m.end(), "courant_mutants::Sign{{{n}}} * -")
    for m in re.finditer(r" ([+-]=) ", mask):
        end = statement_end(mask, m.end())
        if end > 0 and "\n\n" not in mask[m.end():end] and "," not in re.sub(r"\(.*?\)", "", mask[m.end():end]):
            add("sign", m.end(), end - 1, "courant_mutants::Sign{{{n}}} * (" + braces(text[m.end():end - 1]) + ")")
    for m in re.finditer(r"(?<=[\w)\]]) \* (?=[\w(])", mask):
        add("factor", m.start(), m.end(), " * courant_mutants::One{{{n}}} * ")
    for m in re.finditer(r"(?<=[\w)\]]) / (?=[\w(])", mask):
        add("factor", m.start(), m.end(), " / courant_mutants::Inverse{{{n}}} / ")
    for m in re.finditer(r"(?<=[\w)\]]) (<=?|>=?|==|!=) (?=[\w(\-~*&!])", mask):
        add("comparison", m.start(1), m.end(1), m[1] + " courant_mutants::" + COMPARISONS[m[1]] + "{{{n}}} " + m[1])
    for m in re.finditer(r" (&&|\|\|) ", mask):
        end = operand_end(mask, m.end())
        if end > 0:
            keep = ON if m[1] == "&&" else "!" + ON
            join = "||" if m[1] == "&&" else "&&"
            add("condition", m.end(), end, f"({keep} {join} ({braces(text[m.end():end])}))")
    for m in re.finditer(r"\b(?:if|while) \(", mask):
        end = closing(mask, m.end() - 1)
        inner = mask[m.end():end]
        if end > 0 and ";" not in inner and not re.search(r"[^=!<>]=[^=]", inner):
            add("negation", m.end(), end, ON + " != bool(" + braces(text[m.end():end]) + ")")
    for m in re.finditer(r"(?<=[;{})])\s*\n *([A-Za-z_*+(-])|(?<=else)\n *([A-Za-z_*+(-])", mask):
        begin = m.end() - 1
        end = statement_end(mask, begin)
        first = mask[begin:end] if end > 0 else ""
        if not first or STARTS_NO_EXPRESSION.match(first) or DECLARATION.match(first) or not re.search(r"[=(+-]|continue|break", first):
            continue
        add("deletion", begin, end, "{{ if (!" + ON + ") " + braces(text[begin:end]) + " }}")
    for m in re.finditer(r"(?<![\w.'])(\d+)(?![\w.'])", mask):
        kind = "index" if mask[m.start() - 1] == "[" and mask[m.end():m.end() + 1] == "]" else "number"
        add(kind, m.start(), m.end(), f"({m[1]} + {ON})")
    for m in re.finditer(r"(?<![\w.'])(\d+\.\d*(?:e[+-]?\d+)?|\d+e[+-]?\d+)(?![\w.'])", mask):
        add("number", m.start(), m.end(), f"({ON} ? 2 * {m[1]} : {m[1]})")
    for m in re.finditer(r"\bstd::(min|max)\((?!\{)", mask):
        add("least", m.start(), m.end() - 1, "courant_mutants::Least{{{n}, " + ("true" if m[1] == "min" else "false") + "}}")
    for m in re.finditer(r"(?<=[( ,=])(true|false)(?=[;,) ])", mask):
        add("truth", m.start(), m.end(), f"({ON} != {m[1]})")
    lines = mask.split("\n")
    return [place for place in found
            if not any(SKIPPED_LINE.search(line)
                       for line in lines[text.count("\n", 0, place[1]):text.count("\n", 0, place[2]) + 1])]


def braces(text):
    return text.replace("{", "{{").replace("}", "}}")
