"""What can be wrong with pictures: with those of a camera, and with what is found in them."""
