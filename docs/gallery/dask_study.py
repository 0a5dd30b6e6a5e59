# SPDX-License-Identifier: LGPL-2.1-or-later
"""A study on a cluster: here four designs on a Dask of this machine."""

import trimesh
from distributed import Client, LocalCluster

import volfrep

if __name__ == "__main__":
    box = volfrep.as_solid(trimesh.creation.box((30, 20, 20)))
    study = volfrep.Study(parts=(box,), vary={"cell": ("BCC", "CVC"), "strut_radius": (0.8, 1.0)})
    with LocalCluster(n_workers=2, threads_per_worker=1) as cluster, Client(cluster):
        made = volfrep.sweep(study, "runs", scheduler=cluster.scheduler_address)
    print(made.to_frame()[["cell", "strut_radius", "forecast.mass_g"]])
