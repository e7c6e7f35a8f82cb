"""Errors of the program, as exceptions."""


class VoxrayError(Exception):
    """What the program said, such as "session.yaml:3: voxelize.resolution: ..."."""
