"""How a ride compares with the one that does nothing."""


def mismatch_ratio(mismatch: float, still: float) -> float:
    """R = max(M, 1) / max(M_still, 1), of a ride and of the same flight by method `still`.

    mismatch, still: their M, in just noticeable differences (`Mismatch`). M_still has the same
    stage and a cabin that stands upright and does not turn. At 1 a ride is as far from the flight
    as that; what cannot be felt, M below 1, is worth nothing, so that no ratio is made of it.
    """
    return max(mismatch, 1.0) / max(still, 1.0)
