"""Fabrics drape as in Cusick's test, and flags flap by themselves; see benchmarks/fabrics.py."""

from benchmarks.fabrics import drape, flap


def test_a_disc_falls_in_four_to_eight_folds_and_stiffer_fabrics_hang_wider() -> None:
    found = [drape(name, rings=10, seconds=2.0) for name in ("silk", "cotton", "wool")]
    assert all(4 <= each.nodes <= 8 for each in found)
    silk, cotton, wool = (each.coefficient for each in found)
    assert 0.25 < silk < 0.5 < cotton < 0.65 < wool < 0.95


def test_a_flag_begins_to_flap_above_a_speed_and_then_faster_in_faster_wind() -> None:
    calm, slow, fast = (flap("cotton", speed, seconds=6.0) for speed in (0.25, 1.0, 4.0))
    assert calm.amplitude < 0.02
    assert 0.05 < slow.amplitude < 1 and 0.05 < fast.amplitude < 1
    assert fast.frequency > 1.3 * slow.frequency
