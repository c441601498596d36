"""Ways to break a file, each called with the file and all files of its kind."""


def truncate(victim, _):
    """Cut a file to a third."""
    victim.write_bytes(victim.read_bytes()[: victim.stat().st_size // 3])


def zero(victim, _):
    """Overwrite a file with zeros."""
    victim.write_bytes(bytes(victim.stat().st_size))


def flip(victim, _):
    """Flip a bit in the middle."""
    content = bytearray(victim.read_bytes())
    content[len(content) // 2] ^= 0x10
    victim.write_bytes(content)


def swap(victim, files):
    """Exchange the content of two files of a kind."""
    other = next(f for f in files if f != victim and f.read_bytes() != victim.read_bytes())
    victim.write_bytes(other.read_bytes())


def remove(victim, _):
    """Remove a file."""
    victim.unlink()
