"""What a page must be, asked of a real browser: each check returns what is wrong, as sentences."""

from pathlib import Path
from urllib.parse import unquote, urlsplit

AXE = "async () => (await axe.run(document, {resultTypes: ['violations']})).violations"
LINKS = "() => [...document.querySelectorAll('[href], [src]')].map(" + (
    "e => e.getAttribute('href') ?? e.getAttribute('src'))"
)
WIDE = """() => {
  const room = document.documentElement.clientWidth;
  if (document.documentElement.scrollWidth <= room) return [];
  const clips = e => getComputedStyle(e).overflowX !== 'visible';
  const clipped = e => e && (clips(e) || clipped(e.parentElement));
  const found = [...document.body.querySelectorAll('*')]
    .filter(e => e.getBoundingClientRect().right > room + 1 && !clipped(e.parentElement))
    .map(e => `${e.tagName} reaches ${Math.ceil(e.getBoundingClientRect().right)} of ${room} px`);
  return found.length ? found.slice(0, 5) : ['the page scrolls sideways'];
}"""
GROUNDS = """() => [...document.querySelectorAll('figure svg, .gallery svg')].map(svg => {
  for (let e = svg; e; e = e.parentElement) {
    const ground = getComputedStyle(e).backgroundColor;
    if (ground !== 'rgba(0, 0, 0, 0)') return ground;
  }
  return 'none';
})"""
FIGURES = """() => [...document.querySelectorAll('figure')].map(figure => [
  figure.getBoundingClientRect().height, getComputedStyle(figure).breakInside])"""
# What an A4 page leaves between its margins, in CSS pixels: 96 to an inch of 25.4 mm.
PAPER_WIDTH = round((210 - 2 * 16) / 25.4 * 96)
PAPER_HEIGHT = (297 - 2 * 18) / 25.4 * 96


class Visit:
    """A page in a window of its own, with what it said and what it asked for."""

    def __init__(self, browser, url, *, width=1200, scheme="light", media="screen"):
        self.url, self.said, self.asked = url, [], []
        size = {"width": width, "height": 900}
        self.context = browser.new_context(viewport=size, color_scheme=scheme)
        self.context.route("**/*", self._answer)
        self.page = self.context.new_page()
        self.page.on("console", lambda message: self.said.append(f"{message.type} {message.text}"))
        self.page.on("pageerror", lambda error: self.said.append(f"error {error}"))
        self.page.on("request", lambda request: self.asked.append(request.url))
        self.page.emulate_media(media=media, color_scheme=scheme)
        self.page.goto(url)

    def _answer(self, route):
        """Let the page itself through; whatever else it asks for is noted and refused."""
        if route.request.url == self.url:
            route.continue_()
        else:
            route.abort()

    def complaints(self):
        """Return the errors and warnings that the page left in the console."""
        return [line for line in self.said if line.split()[0] in ("error", "warning")]

    def requests(self):
        """Return what the page asked for beside itself."""
        return [url for url in self.asked if url.partition("#")[0] != self.url]

    def broken_links(self):
        """Return the links and anchors that lead nowhere, or off this machine."""
        found = []
        for link in set(self.page.evaluate(LINKS)):
            parts = urlsplit(link)
            if parts.scheme == "data":
                continue  # an image that the page holds
            if parts.scheme or parts.netloc:
                found.append(f"{link} leaves the page")
            elif parts.path and not (self._folder() / unquote(parts.path)).is_file():
                found.append(f"{link} names no file")
            elif not parts.path and not self._has(unquote(parts.fragment)):
                found.append(f"{link} names no place")
        return sorted(found)

    def _folder(self):
        return Path(unquote(urlsplit(self.url).path)).parent

    def _has(self, name):
        return self.page.evaluate("name => document.getElementById(name) !== null", name)

    def too_wide(self):
        """Return the elements that make the page scroll sideways."""
        return self.page.evaluate(WIDE)

    def dark_grounds(self):
        """Return the grounds of figures that are not white."""
        return [ground for ground in self.page.evaluate(GROUNDS) if ground != "rgb(255, 255, 255)"]

    def split_figures(self):
        """Return the figures that a page break may go through."""
        found = []
        for height, inside in self.page.evaluate(FIGURES):
            if inside != "avoid":
                found.append("may break inside")
            if height > PAPER_HEIGHT:
                found.append(f"{height:.0f} of {PAPER_HEIGHT:.0f} px high")
        return found

    def violations(self, axe):
        """Return what axe-core, a file, finds against accessibility."""
        self.page.add_script_tag(path=axe)
        return [
            f"{one['id']}: {one['help']}: {[node['target'] for node in one['nodes'][:3]]}"
            for one in self.page.evaluate(AXE)
        ]
