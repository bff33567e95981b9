"""The command line: arguments, progress, tables, exit codes. Holds no science."""
