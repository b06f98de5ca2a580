# Every target makes the virtual environment that it needs in .venv/. Nothing outside of this
# directory is changed.

VENV = .venv
BIN = $(VENV)/bin
PYTHONS = python3 python3.12 python3.13 python3.14 python3.11 python3.10
PIP_INSTALL = $(BIN)/python -m pip --disable-pip-version-check install --quiet

DEMO = demo
SCAFFOLD = $(BIN)/ros2-scaffold
# All tests of a file stay in one process: they share what they build.
PYTEST = $(BIN)/python -m pytest --numprocesses auto --dist loadfile --no-loadscope-reorder
# Shows a command as it would be typed, and runs it.
RUN = @show() { echo; echo "\$$ ros2-scaffold $$*"; cd $(DEMO) && ../$(SCAFFOLD) "$$@"; }; show

# Set while a program of another environment with the ROS wheels runs make.
ifdef _ROS_WHEELS_BOOTSTRAP_COMPLETE
unexport _ROS_WHEELS_BOOTSTRAP_COMPLETE LD_LIBRARY_PATH
endif

.PHONY: help
help:
	@echo 'make demo        generate a package, check it, build it, run it, observe it'
	@echo 'make test        all tests, real builds included; PYTEST_ARGS=... for pytest'
	@echo 'make test-quick  the tests without real builds'
	@echo 'make nightly     broken packages through `check`, and killed runs; takes hours'
	@echo 'make test-rules  the examples of all rules, in a small environment; PYTEST_ARGS=...'
	@echo 'make versions    all tests on every Python from 3.10 to 3.14 that is installed'
	@echo 'make lint        ruff, mypy and the direction of imports, on the whole repository'
	@echo 'make style       style compared with the linters of ament, on the Python of Jazzy'
	@echo 'make format      let ruff format the code'
	@echo 'make examples    write what rules report now into their examples; CODES=... for some'
	@echo 'make docs        write the pages below docs/ that are made from the code'
	@echo 'make benchmark   how fast the tool is, as ratios'
	@echo 'make clean       remove what all of these have made'

.PHONY: demo
demo: $(VENV)/demo.stamp
	@rm -rf $(DEMO) && mkdir $(DEMO)
	$(RUN) new talker --topic chatter
	$(RUN) check talker
	$(RUN) smoke talker
	@echo; echo 'The package is in $(DEMO)/talker.'

.PHONY: test
test: $(VENV)/test.stamp
	$(PYTEST) $(PYTEST_ARGS)

.PHONY: test-quick
test-quick: $(VENV)/test.stamp
	$(PYTEST) -m 'not build' $(PYTEST_ARGS)

.PHONY: nightly
nightly: $(VENV)/test.stamp
	$(BIN)/python -m pytest -m nightly tests/nightly $(PYTEST_ARGS)
	$(PYTEST) -m hypothesis --hypothesis-profile random $(PYTEST_ARGS)

.PHONY: test-rules
test-rules: $(VENV)/rules.stamp
	$(BIN)/python -m pytest tests/check/test_rules.py $(PYTEST_ARGS)

.PHONY: versions
versions: $(VENV)/test.stamp
	$(BIN)/nox -- $(PYTEST_ARGS)

.PHONY: lint
lint: $(VENV)/test.stamp
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/mypy
	$(BIN)/lint-imports

# Without a Python 3.12, nox says so and goes on.
.PHONY: style
style: $(VENV)/test.stamp
	$(BIN)/nox --session style -- --quiet

.PHONY: format
format: $(VENV)/test.stamp
	$(BIN)/ruff format .

.PHONY: examples
examples: $(VENV)/rules.stamp
	$(BIN)/python scripts/pin_examples.py $(CODES)
	$(BIN)/ruff format --quiet rules

.PHONY: docs
docs: $(VENV)/rules.stamp
	$(SCAFFOLD) rules --write-docs docs/rules
	$(BIN)/python scripts/document_api.py
	$(BIN)/python scripts/document_configuration.py
	$(BIN)/python scripts/document_distributions.py
	$(BIN)/python scripts/document_smoke_report.py

# Packages to measure: as many as the argument of seq says.
build/benchmark: $(VENV)/test.stamp
	@echo 'writing packages to measure'
	@rm -rf $@ && mkdir -p $@
	@for number in $$(seq 40); do \
	  $(SCAFFOLD) new package_$$number --destination-directory $@ > /dev/null 2>&1 || exit; \
	done

.PHONY: benchmark
benchmark: build/benchmark
	PATH="$(CURDIR)/$(BIN):$$PATH" $(BIN)/python benchmarks/check_speed.py build/benchmark \
	  --ament $(BIN)

.PHONY: clean
clean:
	rm -rf $(VENV) $(DEMO) .nox build dist .hypothesis .mypy_cache .pytest_cache .ruff_cache
	find . -name __pycache__ -type d -prune -exec rm -rf {} +

# The environment. A stamp is younger than what its contents were made from.

$(VENV)/demo.stamp: $(VENV)/made.stamp pyproject.toml
	@echo 'installing ros2-scaffold and ROS 2 Jazzy into $(VENV)/ (about 400 MB, once)'
	@$(PIP_INSTALL) --editable '.[ros]'
	@touch $@

$(VENV)/rules.stamp: $(VENV)/made.stamp pyproject.toml
	@$(PIP_INSTALL) --editable '.[test-rules]'
	@touch $@

$(VENV)/test.stamp: $(VENV)/made.stamp pyproject.toml
	@echo 'installing ros2-scaffold, ROS 2 Jazzy and the test tools into $(VENV)/ (once)'
	@$(PIP_INSTALL) --editable '.[ros,test]'
	@touch $@ $(VENV)/demo.stamp $(VENV)/rules.stamp

$(VENV)/made.stamp:
	@for python in $(or $(PYTHON),$(PYTHONS)); do \
	  $$python -c 'import sys, ensurepip, venv; sys.exit(sys.version_info < (3, 10))' \
	    2> /dev/null || continue; \
	  $$python -m venv --clear $(VENV) && touch $@ && exit 0; \
	done; \
	echo 'no Python 3.10 or newer with its venv module was found; on Debian and Ubuntu:' >&2; \
	echo '  apt-get install python3-venv' >&2; \
	echo 'or say which one to use: make PYTHON=/path/to/python3' >&2; \
	exit 1
