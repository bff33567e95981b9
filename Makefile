# Every target makes the environment that it needs; `PYTHON` chooses the interpreter to make it with.
PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
LOWEST := .venv-lowest
PEERS := .venv-bench

.PHONY: walk human test check verify gallery bench test-lowest clean

walk: $(VENV)/.installed  ## validate all documents and walk the cat: figures, results, claims (met or not)
	$(BIN)/neuromech validate specs
	$(BIN)/neuromech run specs/cat/walk.yaml --out results/walk || test $$? -eq 4

human: $(VENV)/.installed  ## the planar human walks on reflexes: figures, results, claims (met or not)
	$(BIN)/python -m pip install --quiet --editable '.[mujoco]'
	$(BIN)/neuromech run specs/human/walk.yaml --out results/human || test $$? -eq 4

test: $(VENV)/.developed  ## the whole fast test-suite
	$(BIN)/python -m pytest

check: $(VENV)/.developed  ## style, types, layers
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/mypy
	$(BIN)/python -m pytest --quiet tests/test_layers.py

verify: $(VENV)/.developed  ## the slow proofs, and every claim of the shipped documents
	$(BIN)/python -m pip install --quiet --group opensim
	$(BIN)/python -m pytest -m slow
	$(BIN)/python -m pytest tests/unit/components/test_muscle_against_opensim.py
	$(BIN)/neuromech verify specs

gallery: $(VENV)/.developed  ## draw the pictures of docs/gallery again
	$(BIN)/python .ci/gallery.py

bench: $(VENV)/.developed $(PEERS)/.installed  ## ratios to peers and limits, measured side by side
	$(BIN)/neuromech bench --python $(PEERS)/bin/python
	$(BIN)/python tests/benchmarks/real_time.py

test-lowest: $(LOWEST)/.developed  ## the test-suite with the lowest versions that pyproject.toml allows
	$(LOWEST)/bin/python -m pytest -W ignore::DeprecationWarning  # of old packages about their newer dependencies

clean:  ## forget all environments
	rm -rf $(VENV) $(LOWEST) $(PEERS)

$(VENV)/.installed: pyproject.toml
	$(PYTHON) -c 'import sys; sys.version_info >= (3, 11) or sys.exit("Python 3.11 or newer is needed: make PYTHON=python3.11")'
	$(BIN)/python -c '' 2>/dev/null || $(PYTHON) -m venv --clear $(VENV)
	$(BIN)/python -m pip install --quiet --upgrade 'pip>=25.1'
	$(BIN)/python -m pip install --quiet --editable .
	touch $@

$(VENV)/.developed: $(VENV)/.installed
	$(BIN)/python -m pip install --quiet --group dev
	touch $@

$(LOWEST)/.developed: pyproject.toml .ci/lowest.py
	$(PYTHON) -m venv --clear $(LOWEST)
	$(LOWEST)/bin/python .ci/lowest.py > $(LOWEST)/constraints.txt
	$(LOWEST)/bin/python -m pip install --quiet --upgrade 'pip>=25.1'
	$(LOWEST)/bin/python -m pip install --quiet --constraint $(LOWEST)/constraints.txt --editable . --group dev
	touch $@

# SNS-Toolbox without what it depends on: its NumPy back end needs no torch, which is some gigabytes.
$(PEERS)/.installed: tests/benchmarks/peers/requirements.txt
	$(PYTHON) -m venv --clear $(PEERS)
	$(PEERS)/bin/python -m pip install --quiet --requirement $<
	$(PEERS)/bin/python -m pip install --quiet --no-deps 'sns-toolbox==1.5.2'
	touch $@
