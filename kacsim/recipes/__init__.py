"""What every result file says of how it was made: the words, and where each kind carries them."""
