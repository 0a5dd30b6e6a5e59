# SPDX-License-Identifier: LGPL-2.1-or-later
"""A graph of networkx, whose nodes have places, as a lattice in free space."""

import networkx

import volfrep

graph = networkx.grid_graph((3, 3, 3))
for place in graph:
    graph.nodes[place]["pos"] = [9.0 * number for number in place]
part = volfrep.mesh_network(graph, strut_radius=0.8)
print(part.report.genus == graph.number_of_edges() - graph.number_of_nodes() + 1)
part.save("grid.3mf")
