"""`python -m neuromech.cli` is the command line without an installed script."""

from neuromech.cli.main import main

main()
