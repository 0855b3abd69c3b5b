// An object with an id, in sessionStorage: it survives a reload of the page. If the browser blocks the storage, the
// object is lost by a reload.
export function stored(key) {
  return {
    read() {
      try {
        return JSON.parse(sessionStorage.getItem(key));
      } catch {
        return null;
      }
    },
    // value: the object, or null to remove it.
    write(value) {
      try {
        value ? sessionStorage.setItem(key, JSON.stringify(value)) : sessionStorage.removeItem(key);
      } catch {}
    },
  };
}
