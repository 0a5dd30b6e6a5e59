# SPDX-License-Identifier: LGPL-2.1-or-later
# Everything from one word. `make demo` and `make test` begin with the set-up, which installs what
# is missing on Debian 12 or 13 (as root) and takes no time when nothing is.

SHELL := /bin/bash
PYTHON := .venv/bin/python
# FreeCAD with a profile of its own, on a virtual screen where it needs one.
export FREECAD_USER_HOME := $(CURDIR)/.cache/fchome
# Tests start Python some hundred times: it keeps what it has compiled, whatever the shell says.
unexport PYTHONDONTWRITEBYTECODE
SCREEN := xvfb-run -a -s "-screen 0 1600x1200x24 -dpi 96"

.NOTPARALLEL:
.PHONY: help setup setup-light demo check test test-all test-slow lint format test-core test-random test-alone test-freecad \
	test-gui test-in-freecad test-freecad-1 translations test-newest docs-pictures docs-tables \
	digests vocabulary validate release test-wheel test-wine test-release site test-escape test-menu torture fuzz bench bench-quick bench-readme catalogue crush-curves clean

help: ## show this list
	@sed -nE 's/^([a-z-]+):.*## (.*)/  make \1\t\2/p' $(MAKEFILE_LIST) | expand -t 25

setup: ## install what is missing: FreeCAD, Python packages, a private FreeCAD profile
	@tools/setup.sh

# What needs neither FreeCAD nor other programs.
setup-light:
	@tools/setup.sh light

demo: setup ## model a bracket, fill it, and leave files and a picture in build/demo
	@mkdir -p build/demo
	@freecadcmd demo/fill_bracket.py < /dev/null
	@$(SCREEN) $(PYTHON) demo/render.py cutaway build/demo/bracket.stl \
		build/demo/bracket_solid.stl 3 build/demo/bracket.png
	@$(SCREEN) $(PYTHON) demo/render.py cells build/demo/cells.png
	@$(SCREEN) $(PYTHON) demo/render.py graded build/demo/graded.png
	@ls -l build/demo

test: MARK := not slow and not costly
test: setup ## style, types, and every test but the slow and the costly ones (500 s of a processor)
	@$(SIDE_BY_SIDE) $(WINDOWS) , "lint=make --no-print-directory lint" $(OTHERS)

test-all: MARK :=
test-all: setup ## the same with all of these
	@$(SIDE_BY_SIDE) $(WINDOWS) , "lint=make --no-print-directory lint" $(OTHERS)

test-slow: MARK := slow or costly
test-slow: setup ## what test-all has beyond test
	@$(SIDE_BY_SIDE) $(WINDOWS) , $(OTHERS)

# Windows wait more than they compute: they have two lanes, each run a screen and a profile of its
# own, and the processor first. The lanes take about as long as each other. Scripts of a group share
# a window, as FreeCAD takes long to start; a script that is in no group has its own.
GUI_GROUPS := commands+display+manners+tree fresh+lattice_infill+look \
	panel+reach+sizing+study window+escape+languages preferences+print
GUI_FIRST := commands+display+manners+tree window+escape+languages preferences+print
# Of each script `make test` runs few checks: one window a lane has time for them.
test: GUI_FIRST := commands+display+manners+tree+window+escape+languages+preferences+print
test: GUI_GROUPS := $(GUI_FIRST) fresh+lattice_infill+look+panel+reach+sizing+study
GUI_ALONE := $(filter-out $(subst +, ,$(GUI_GROUPS)),\
	$(patsubst drive_%.py,%,$(notdir $(sort $(wildcard tests/gui/drive_*.py)))))
SIDE_BY_SIDE = $(PYTHON) tools/side_by_side.py
lane = $(foreach group,$(1),"window-$(group)=tools/run_gui.sh \
	$(patsubst %,tests/gui/drive_%.py,$(subst +, ,$(group)))")
WINDOWS = $(call lane,$(GUI_FIRST)) , \
	$(call lane,$(filter-out $(GUI_FIRST),$(GUI_GROUPS) $(GUI_ALONE)))
IN_FREECAD = "freecad=make --no-print-directory test-freecad"
OTHERS = $(IN_FREECAD) , "core=make --no-print-directory test-core"

check: setup-light ## style, types, and the tests nearest to what changed, in FreeCAD too, in a minute (SECONDS=50, BASE=main)
	@$(PYTHON) tools/check.py $(if $(BASE),--base $(BASE)) $(if $(SECONDS),--seconds $(SECONDS))

lint: setup-light ## ruff and mypy
	@.venv/bin/ruff check .
	@.venv/bin/ruff format --check .
	@.venv/bin/mypy

format: setup-light ## let ruff rewrite the sources
	@.venv/bin/ruff format .
	@.venv/bin/ruff check --fix .

# Two runs of tests share the cores: threads of the library behind numpy only wait for each other.
test test-all test-slow check test-core test-random test-freecad test-in-freecad test-gui \
	test-freecad-1 test-newest: export OPENBLAS_NUM_THREADS := 1

# Which tests: pytest's word for it, that the windows' scripts know, too (tools/run_gui.sh). By way
# of the environment, so that the parts of test, test-all and test-slow see it. Costly ones, that
# `test` leaves out, run on other versions: of the engine in test-newest, of the workbench and its
# windows in test-freecad-1, where no mark is given.
export MARK ?= not slow
# What the tests take of the processor is told at the end, with the costliest cases.
COST := -p tools.processor_time
test-core: setup ## the engine's tests on plain Python
	@$(PYTHON) -m pytest tests/core -m "$(MARK)" -n auto --dist loadfile $(COST)

test-random: setup ## searches by chance, with other seeds every time, in the engine's tests
	@$(PYTHON) -m pytest tests/core -m "hypothesis and not slow" --hypothesis-profile=random \
		-n auto $(COST)

# What uses real parts, and the benchmark's jobs on them, where there are none.
test-alone: export VOLFREP_PARTS := $(CURDIR)/build/no-parts
test-alone: export VOLFREP_TORTURE := $(CURDIR)/build/no-torture
test-alone: setup ## the tests and jobs that take real parts, as in a checkout with nothing beside it
	@$(PYTHON) -m pytest -q -rs -n auto -k "not modelled" -m "not slow" tests/core/test_bench.py \
		tests/core/jobs/test_parts.py tests/core/shell/test_offset.py \
		tests/core/io/test_slicers.py tests/core/io/test_solid.py tests/core/io/test_torture.py
	@PYTEST_ARGS='-q -rs tests/freecad/test_freecad_parts.py' \
		freecadcmd tools/run_in_freecad.py < /dev/null
	@$(PYTHON) -m bench --quick --only rod

test-freecad: setup ## the workbench's tests in the real freecadcmd
	@PYTEST_ARGS='tests/freecad -m "$(MARK)" $(COST)' freecadcmd tools/run_in_freecad.py < /dev/null

test-in-freecad: setup ## both of these side by side
	@$(SIDE_BY_SIDE) $(WINDOWS) , $(IN_FREECAD)

test-gui: MARK :=
test-gui: setup ## every check of the real FreeCAD window, on a virtual screen
	@$(SIDE_BY_SIDE) $(WINDOWS)

test-menu: setup ## every entry of the menu clicked, for docs/commands/clicked.md (tools/menu_table.py)
	@tools/run_gui.sh tests/gui/drive_reach.py click_every_entry_of_the_menu < /dev/null

test-escape: setup ## Escape at ten random times in every long command of the window, a quarter of an hour
	@ESCAPES=10 GUI_LONGEST=900 GUI_TIMEOUT=3600 tools/run_gui.sh tests/gui/drive_escape.py < /dev/null

docs-pictures: setup ## the pictures of the tutorial and the help pages anew, and the animation
	@tools/docs_pictures.sh $(FROM)
	@$(if $(FROM),,tools/film.sh)

fuzz: setup ## random solids and options, judged without the engine (MINUTES=5, SEED=...)
	@$(PYTHON) tools/fuzz.py --minutes $(or $(MINUTES),5) $(if $(SEED),--seed $(SEED))

translations: setup ## refresh the .ts files from the sources, and compile them (lrelease)
	@$(PYTHON) tools/translations.py

docs-tables: setup ## the documentation's tables of parameters anew, from the program's own
	@$(PYTHON) tools/parameter_tables.py

catalogue: setup ## cells that the catalogue lacks, and the charts of docs/cells.md (half a minute a cell)
	@$(PYTHON) tools/catalogue.py $(CATALOGUE_ARGS)

crush-curves: setup ## the crush curves that ship and are missing (some seconds to a minute each)
	@$(PYTHON) tools/crush_curves.py

validate: setup ## predictions beside printed specimens, the figures of docs/validation.md and of homogenised parts (15 min)
	@$(PYTHON) tools/validate.py $(VALIDATE)

torture: setup ## every broken, odd and real file beside what it must get
	@PYTHONPATH=. $(PYTHON) tests/core/torture.py

test-freecad-1: ## the workbench's tests in FreeCAD 1.0 and 1.1, and the wheel, each in a Debian of its own (root)
	@status=0; for suite in trixie forky; do \
	tools/freecad_in.sh $$suite test-in-freecad test-wheel < /dev/null || status=$$?; done; exit $$status

digests: setup ## whether a change altered a file that the command writes, 3 min (DIGESTS="--write")
	@$(PYTHON) tools/digests.py $(DIGESTS)

vocabulary: setup ## whether a change altered a word that a user meets (VOCABULARY="--write")
	@$(PYTHON) tools/vocabulary.py $(VOCABULARY)

test-newest: ## the engine's tests on the newest numpy, scipy and scikit-image
	@tools/newest.sh

SITE := .cache/site/bin/mkdocs
$(SITE): tools/requirements-site.txt
	@python3 -m venv .cache/site
	@.cache/site/bin/pip install --quiet --disable-pip-version-check -r $<
	@touch $@

release: setup-light $(SITE) ## what users get, from the tag of this version, in build/release (STATE=HEAD: any other state)
	@tools/release.sh $(STATE)

test-wheel: setup-light ## the wheel as users install it, in every Python found here
	@rm -rf build/wheel
	@$(PYTHON) -m pip wheel --quiet --disable-pip-version-check --no-deps -w build/wheel .
	@rm -rf build/lib build/bdist.*
	@$(PYTHON) tools/test_wheel.py build/wheel

test-wine: setup-light ## a block and tests in Windows' Python under Wine (root the first time, 0.7 GB)
	@tools/wine.sh $(TESTS)

test-release: setup-light $(SITE) ## what users get, made and tried: archive, wheel in every Python found here, site
	@tools/release.sh .
	@$(PYTHON) tools/test_wheel.py build/release
	@$(MAKE) --no-print-directory site

site: setup $(SITE) ## the documentation as a site, in build/site: its examples are run; a warning is an error
	@$(PYTHON) tools/page_examples.py
	@NO_MKDOCS_2_WARNING=1 .cache/site/bin/python tools/site.py

bench: setup ## the paper's evaluation beside it and other tools, into docs/benchmarks.md and README (30 min)
	@tools/bench_tools.sh
	@$(PYTHON) -m bench $(BENCH_ARGS)

bench-readme: BENCH_ARGS := --readme
bench-readme: bench ## only what the README's table tells of, into it (6 min)

bench-quick: BENCH_ARGS := --quick
bench-quick: bench ## a small part of it, into build/bench-quick (5 min)

clean: ## remove what was made; the installed Debian packages stay
	rm -rf .venv .cache build .pytest_cache .mypy_cache .ruff_cache .hypothesis core/*.egg-info
	find . -name __pycache__ -prune -exec rm -rf {} +
