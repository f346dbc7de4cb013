"""Reads what `trodden crowd` wrote with PedPy, as a researcher would, and compares it with what trodden said of it.

    check.py SUMMARY.json PATHS.txt PATHS.sqlite

Exits with 1 and says what differs.
"""

import json
import pathlib
import sys

import numpy as np
import pedpy


def walked(trajectories):
    """Metres that all walked, and the seconds that it took them."""
    data = trajectories.data.sort_values(["id", "frame"])
    steps = data.groupby("id")[["x", "y", "frame"]].diff().dropna()
    return np.hypot(steps.x, steps.y).sum(), steps.frame.sum() / trajectories.frame_rate


class Check:
    def __init__(self):
        self.failures = 0

    def equal(self, what, found, said):
        self.near(what, found, said, 0.0)

    def near(self, what, found, said, tolerance):
        """`tolerance` is a share of what trodden said."""
        right = abs(found - said) <= tolerance * abs(said)
        self.failures += not right
        print(f"{'ok ' if right else 'BAD'}  {what:<44} PedPy {found:12.4f}   trodden {said:12.4f}")


def main(summary, text, database):
    said = json.loads(pathlib.Path(summary).read_text())
    check = Check()
    loaded = {
        "text": pedpy.load_trajectory(trajectory_file=pathlib.Path(text)),
        "sqlite": pedpy.load_trajectory_from_jupedsim_sqlite(trajectory_file=pathlib.Path(database)),
    }
    area = pedpy.load_walkable_area_from_jupedsim_sqlite(trajectory_file=pathlib.Path(database))
    for name, trajectories in loaded.items():
        metres, seconds = walked(trajectories)
        speeds = pedpy.compute_individual_speed(
            traj_data=trajectories,
            frame_step=1,
            speed_calculation=pedpy.SpeedCalculation.BORDER_SINGLE_SIDED,
        )
        check.equal(f"{name}: people", trajectories.number_pedestrians, said["people"]["entered"])
        check.equal(f"{name}: frames per second", trajectories.frame_rate, said["motion"]["fps"])
        check.equal(f"{name}: places", len(trajectories.data), said["motion"]["places"])
        # Counted from 0, and in the last frame nobody is left.
        check.equal(f"{name}: frames", trajectories.data.frame.max() + 2, said["motion"]["frames"])
        check.near(f"{name}: metres walked", metres, said["metres"], 0.002)
        check.near(f"{name}: seconds present", seconds, said["person_seconds"], 0.002)
        check.near(f"{name}: mean speed, m/s", metres / seconds, said["mean_speed_m_s"], 0.002)
        check.near(f"{name}: mean of PedPy's individual speeds", speeds.speed.mean(), said["mean_speed_m_s"], 0.03)
        inside = pedpy.is_trajectory_valid(traj_data=trajectories, walkable_area=area)
        check.equal(f"{name}: everybody on the walkable area", inside, True)

    places = [data.data.sort_values(["id", "frame"])[["id", "frame", "x", "y"]] for data in loaded.values()]
    apart = np.abs(places[0].to_numpy() - places[1].to_numpy()).max()
    check.equal("largest difference of the two files", apart, 0.0)
    if not area.polygon.is_valid:
        check.failures += 1
        print("BAD  the walkable area is not a valid polygon")
    return check.failures


if __name__ == "__main__":
    sys.exit(1 if main(*sys.argv[1:]) else 0)
