"""Several laws of rotation as virtual cabins, and the mean of them that a real cabin follows.

`member` runs one law beside the vehicle, `loss` says what a rider of it would miss, `weights` turns
the losses of late into shares, `draw` takes the real cabin to the mean of the cabins, and
`committee` puts them together. The laws that `hedge` asks are in its own module.
"""
