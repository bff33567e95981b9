"""`neuromech verify`: every claim of every document."""

from collections.abc import Sequence
from pathlib import Path

from neuromech.cli.consoles import notes, results
from neuromech.cli.documents import document_files
from neuromech.cli.progress import counted
from neuromech.cli.terminal import CLAIM_NOT_MET, FINISHED, write_json
from neuromech.cli.validate import problems_of
from neuromech.cli.verdicts import claims_table
from neuromech.errors import DocumentError
from neuromech.pipeline import load_document
from neuromech.verification import all_met, carry_out, plan


def verify(paths: Sequence[Path], as_json: bool, seeds: int | None) -> int:
    """Run what the claims of all documents need and write the verdicts to stdout; return the exit code.

    Raises:
        DocumentError: a document is wrong; nothing has been run then.
        MeasureError: a claim is wrong.
    """
    files = document_files(paths)
    problems = problems_of(files)
    if problems:
        raise DocumentError(problems)
    plans = [plan(load_document(file), seeds) for file in files]
    with counted(sum(plan.runs() for plan in plans), shown=notes().is_terminal) as progress:
        verdicts = [verdict for plan in plans for verdict in carry_out(plan, progress)]
    if as_json:
        write_json([verdict.as_dict() for verdict in verdicts])
    else:
        results().print(claims_table(verdicts))
    return FINISHED if all_met(verdicts) else CLAIM_NOT_MET
