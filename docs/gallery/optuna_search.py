# SPDX-License-Identifier: LGPL-2.1-or-later
"""Mass against stiffness by Optuna's search, which asks for designs and is told their figures."""

import optuna
import trimesh

import volfrep

box = volfrep.as_solid(trimesh.creation.box((40, 30, 20)))
study = volfrep.Study(
    parts=(box,), fixed={"shell": 2.0}, do=("forecast", "properties"), material="PA12"
)
search = optuna.create_study(
    directions=["minimize", "maximize"], sampler=optuna.samplers.NSGAIISampler(seed=1)
)
for _ in range(6):
    trials = [search.ask() for _ in range(5)]
    designs = [
        {
            "cell": trial.suggest_categorical("cell", ["BCC", "CVC", "Octet"]),
            "cell_size": trial.suggest_float("cell_size", 8.0, 20.0),
            "relative_density": trial.suggest_float("relative_density", 0.05, 0.3),
        }
        for trial in trials
    ]
    for trial, found in zip(trials, volfrep.evaluate(study, designs, "runs"), strict=True):
        if found["error"]:
            search.tell(trial, state=optuna.trial.TrialState.FAIL)
        else:
            search.tell(trial, [found["forecast.mass_g"], found["properties.E100"]])
best = search.best_trials
print(f"{len(best)} designs that no other one beats")
