# SPDX-License-Identifier: LGPL-2.1-or-later
"""The engine's version: the one place where it is written, but for metadata that cannot import.

``pyproject.toml`` reads it from here; package.xml, CITATION.cff and CHANGELOG.md repeat it, and a
test holds them equal.
"""

from __future__ import annotations

VERSION = "0.1.0"
#: What it cannot do without, and manifold3d, without which it does less.
PACKAGES = ("numpy", "scipy", "scikit-image", "trimesh", "manifold3d")


def describe() -> str:
    """The version, and on a second line those of Python and of the packages."""
    import platform

    found = ", ".join(f"{name} {version}" for name, version in versions(PACKAGES).items())
    return f"volfrep {VERSION}\nPython {platform.python_version()}, {found}"


def versions(packages: tuple[str, ...]) -> dict[str, str]:
    """The version of each package; "none" for one that is not installed."""
    from importlib.metadata import PackageNotFoundError, version

    found = {}
    for package in packages:
        try:
            found[package] = version(package)
        except PackageNotFoundError:
            found[package] = "none"
    return found
