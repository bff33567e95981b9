"""Text of modules to be generated in which some lines stand only where something is there: the rest is not compiled."""

import re
from collections.abc import Mapping

_CONDITION = re.compile(r" *if (not )?<([a-z ]+)>:")


def chosen(text: str, flags: Mapping[str, bool]) -> str:
    """Keep what stands below `if <flag>:` where the flag holds, else drop it, and the other way round for `if not`.

    Conditions on names that are no flags stay as they are.
    """
    kept = list[str]()
    conditions = list[tuple[int, bool]]()
    for line in text.splitlines():
        indentation = len(line) - len(line.lstrip())
        while line and conditions and indentation <= conditions[-1][0]:
            conditions.pop()
        found = _CONDITION.fullmatch(line)
        if found and found[2] in flags:
            conditions.append((indentation, flags[found[2]] != bool(found[1])))
        elif not line or all(holds for _, holds in conditions):
            kept.append(line[4 * len(conditions) :])
    return "\n".join(kept) + "\n"
