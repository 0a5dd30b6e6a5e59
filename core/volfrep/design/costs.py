# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a job takes for each cell, strut, triangle and bend: seconds on two cores, bytes, facets.

Measured on two cores of 2020s servers, which differ by a factor of two from hour to hour: seconds
of a fill lie between what two idle cores take and what it takes of one processor. `forecast` adds
them up before a job, `memory_guard` refuses by them; what meshing one cell takes is its kind's
(`kinds`), and what a file takes stands beside its writer and is added up by `reports/estimate`.
"""

#: What the cut adds lies along the seam: as many triangles as the lattice has in a layer at the
#: wall that is so many facets' edges thick. Of 13 parts told over made is 0.77 to 1.18.
SEAM_TRIANGLES = 1.4
#: The skin's wall is looked for where the surface bends (`skin_bends`): seconds, bytes and facets
#: for each bend; and finer where the room between two skins is narrow (`narrow_gaps`). Of 17 parts
#: with a skin of a hundredth of their length, of CVC and of Octet, time and memory are within a
#: factor of two. Seconds of a processor are 1.8 to 2.7e-3 for each bend of seven parts of 3,000 to
#: 28,000 facets, 3.4e-3 of a housing of 92,000.
SECONDS_PER_BEND = 1.6e-3
BYTES_PER_BEND = 5.5e4
FACETS_PER_BEND = 9.0
SECONDS_PER_NARROW = 4e-5
BYTES_PER_NARROW = 2.2e3
#: Of a thin skin whose faces are moved (`skins/plane_faces`) for each body that its wall is cut
#: with. Of a sheet, a plate of needles, a rod, an aerofoil and a block with pockets of balls told
#: over taken is 0.7 to 1.6 for seconds; 55 to 280 facets were made a body of sheet and plate.
SECONDS_PER_BODY = 5.8e-3
BYTES_PER_BODY = 1e5
FACETS_PER_BODY = 100.0
#: Fixed cost, s; per triangle of the octants at the wall, s (of a processor 4.3 to 6.3e-6 in sheets
#: and plates of CVC, FCC and Octet, 6 to 8e-6 in the GE bracket); of the part; of a block; and of
#: one that is written as it is laid, of 35 to 307 million triangles 0.5 to 1.3e-7.
SECONDS = 1.0
SECONDS_PER_CUT_TRIANGLE = 4.2e-6
SECONDS_PER_TRIANGLE = 2.3e-7
SECONDS_PER_BLOCK_TRIANGLE = 4e-7
SECONDS_PER_STREAMED_TRIANGLE = 9e-8
#: A radius or thickness found for a target in a block takes so many seconds and bytes.
SECONDS_FOR_TARGET = 0.6
BYTES_FOR_TARGET = 1e8
#: Seconds for each triangle of the octants that are meshed of a library cell (1.7 to 2.9e-4), and
#: of one period of a TPMS; bytes for each of the latter's.
SECONDS_PER_OCTANT_TRIANGLE = 2.6e-4
SECONDS_PER_PERIOD_TRIANGLE = 8e-5
BYTES_PER_PERIOD_TRIANGLE = 1300.0
#: Facets of a graph's strut; and seconds for each of its triangles, most of them on one core. Of
#: ten random graphs in a rod, a bracket, a box and a ball struts are within 7 %, triangles within
#: 33 % (15 % but for one), processor seconds between 0.7 and 1.0.
TRIANGLES_PER_STRUT = 110.0
SECONDS_PER_NETWORK_TRIANGLE = 2e-5
#: Bytes at the peak: of every job, and for each triangle of a part and of a block. What is refused
#: counts less (`memory_guard`): what is laid out and checked, and what goes into the Boolean.
BYTES = 1e8
BYTES_PER_TRIANGLE = 200.0
BYTES_PER_BLOCK_TRIANGLE = 150.0
BYTES_PER_BOOLEAN_TRIANGLE = 250.0
#: Of a network, no two of whose joints are alike: of 500 and of 1,000 points in the bracket with a
#: skin 0.69 and 1.00 GB were held.
BYTES_PER_NETWORK_TRIANGLE = 900.0
#: Bytes more where octants are moved, which are all different.
BYTES_GRADED = 1.2e8
#: How thick the layer of octants at the wall is, half of it on either side, in units of L, and what
#: the cut leaves of it.
#: Bytes for each triangle left of it and of the wall, and while groups of them are cut; and for
#: each of a whole mesh, where one is wanted: of seven fills of 0.8 to 21 million triangles, struts
#: and gyroids, told over held is 0.8 to 1.2 of files and 1.2 to 1.5 of meshes.
CUT_LAYER = 0.85
LEFT_LAYER = 0.3
BYTES_PER_CUT_TRIANGLE = 85.0
BYTES_OF_GROUPS = 8e7
BYTES_PER_MESH_TRIANGLE = 80.0
#: Bytes of a triangle where only its vertices are kept, each in a place of its own: 18.7 million of
#: a bracket take 0.4 to 0.6 GB more than those of equal cells.
BYTES_PER_PLACED_TRIANGLE = 30.0
#: Bytes that a cell of a block takes whose octants are written as they are laid: 216,000 took 2,020
#: each.
BYTES_PER_STREAMED_CELL = 2500
#: Bytes of a triangle in a file by its form, with the half of a vertex that it has: exact of STL,
#: PLY and GLB; of 3MF, packed, 10.1 to 12.9, OBJ 36.3 to 36.5, OFF 42.3 to 42.9 of cells and TPMS
#: in ten parts; STEP (plane faces) of spheres of 1,000 to 500,000 triangles.
FILE_BYTES = {
    "stl": 50.0, "3mf": 10.0, "ply": 19.0, "obj": 36.0, "off": 42.0, "glb": 18.0, "step": 760.0,
}  # fmt: skip
#: Bytes that a cell of the grid takes while cells and octants are told apart.
BYTES_PER_CELL = 500.0
#: Bytes that a strut of each cell of a block takes where it stays an axis or a beam: 5.2 million of
#: Octet take 0.39 GB in all, 11 million of BCC 0.76.
BYTES_PER_STRUT = 60.0
#: A beam of a 3MF file, with its share of a node: seconds and bytes in memory in a block, the same
#: in a part, where a skin's programs are loaded beside; and bytes of the file. Told over taken, in
#: processor seconds: of blocks of 216,000 and a million cells of Box, CVC, BCC and Octet 0.7 to 1.1
#: for seconds, 0.8 to 1.2 for the file; of a million of BCC in a ball and of CVC in the GE bracket
#: 1.4 and 0.7 for seconds, 1.0 for memory, 1.0 and 0.9 for the file; of 34,000 struts, most of
#: whose time is the skin's, 0.4 for seconds.
SECONDS_PER_BLOCK_BEAM = 1e-6
SECONDS_PER_BEAM = 5.4e-6
BYTES_PER_BEAM = 125.0
BYTES_OF_A_PART = 1.5e8
FILE_BYTES_PER_BEAM = 4.2
