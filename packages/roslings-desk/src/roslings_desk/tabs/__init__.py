"""The tabs of the desk, one file each."""
