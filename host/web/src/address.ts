/** The address of the page, kept up to date with what it shows. */

/** Browsers stop to take another address from who brings more than about three a second. */
const EVERY_MS = 400;

export class Address {
  private last = -Infinity;
  private waits = false;

  /** `hash` says it as of now. */
  constructor(private readonly hash: () => string | Promise<string>) {}

  /** There is another one to show: at once, or soon after the one before. */
  change(): void {
    if (this.waits) return;
    const wait = this.last + EVERY_MS - performance.now();
    if (wait <= 0) {
      void this.write();
      return;
    }
    this.waits = true;
    setTimeout(() => {
      this.waits = false;
      void this.write();
    }, wait);
  }

  /** Without a new entry in the history. */
  private async write(): Promise<void> {
    this.last = performance.now();
    const hash = this.hash();
    const text = typeof hash === 'string' ? hash : await hash;
    if (text === location.hash) return;
    try {
      history.replaceState(null, '', text || location.pathname + location.search);
    } catch {
      // The browser wants no more for now: the link that is copied does not depend on it.
    }
  }
}

/** A link to this page with another hash. */
export function linkWith(hash: string): string {
  return location.href.replace(/#.*$/, '') + hash;
}

/** True: the reader has it. */
export async function copied(link: string): Promise<boolean> {
  try {
    await navigator.clipboard.writeText(link);
    return true;
  } catch {
    return false;
  }
}
